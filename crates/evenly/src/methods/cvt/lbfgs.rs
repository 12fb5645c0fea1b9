//! The limited-memory BFGS method: a direction from the last steps and what they did to the gradient.
//!
//! Nocedal, "Updating Quasi-Newton Matrices with Limited Storage", Mathematics of Computation 35(151), 1980, doi 10.1090/S0025-5718-1980-0572855-7.

use std::collections::VecDeque;

use glam::DVec2;

/// Steps that are remembered; Liu et al. take 7.
const MEMORY: usize = 7;

/// A step, what it changed in the gradient, and the inverse of their product.
struct Step {
    by: Vec<DVec2>,
    gradient: Vec<DVec2>,
    rho: f64,
}

/// The last steps.
#[derive(Default)]
pub(super) struct Memory(VecDeque<Step>);

impl Memory {
    /// Takes a step down, unless the gradient has not grown along it: then it tells nothing of a minimum.
    pub fn remember(&mut self, by: Vec<DVec2>, gradient: Vec<DVec2>) {
        let product = dot(&by, &gradient);
        if product > 1e-12 * (dot(&by, &by) * dot(&gradient, &gradient)).sqrt() {
            self.0.truncate(MEMORY - 1);
            self.0.push_front(Step { by, gradient, rho: 1.0 / product });
        }
    }

    pub fn forget(&mut self) {
        self.0.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The direction to go: minus the inverse Hessian, as far as it is known, times the gradient. `scale` is its inverse before anything is known.
    pub fn direction(&self, gradient: &[DVec2], scale: f64) -> Vec<DVec2> {
        let mut direction: Vec<DVec2> = gradient.iter().map(|&g| -g).collect();
        let mut alphas = Vec::with_capacity(MEMORY);
        for step in &self.0 {
            let alpha = step.rho * dot(&step.by, &direction);
            add(&mut direction, -alpha, &step.gradient);
            alphas.push(alpha);
        }
        let scale = self.0.front().map_or(scale, |last| 1.0 / (last.rho * dot(&last.gradient, &last.gradient)));
        direction.iter_mut().for_each(|d| *d *= scale);
        for (step, alpha) in self.0.iter().zip(alphas).rev() {
            let beta = step.rho * dot(&step.gradient, &direction);
            add(&mut direction, alpha - beta, &step.by);
        }
        direction
    }
}

/// The sum of products, in order.
pub(super) fn dot(a: &[DVec2], b: &[DVec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn add(to: &mut [DVec2], factor: f64, what: &[DVec2]) {
    to.iter_mut().zip(what).for_each(|(to, &what)| *to += factor * what);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_valley_is_gone_down_in_as_many_steps_as_it_has_axes() {
        let curvature = [DVec2::new(1.0, 30.0), DVec2::new(4.0, 0.1)];
        let gradient = |x: &[DVec2]| -> Vec<DVec2> { x.iter().zip(curvature).map(|(&x, c)| c * x).collect() };
        let (mut x, mut memory) = (vec![DVec2::new(3.0, -2.0), DVec2::new(1.0, 5.0)], Memory::default());
        for _ in 0..40 {
            let before = gradient(&x);
            let direction = memory.direction(&before, 0.01);
            // The exact minimum along the direction.
            let length = -dot(&before, &direction) / dot(&gradient(&direction), &direction).max(f64::MIN_POSITIVE);
            add(&mut x, length, &direction);
            let change = gradient(&x).iter().zip(&before).map(|(&a, &b)| a - b).collect();
            memory.remember(direction.iter().map(|&d| length * d).collect(), change);
        }
        assert!(dot(&x, &x) < 1e-20, "{x:?}");
    }
}
