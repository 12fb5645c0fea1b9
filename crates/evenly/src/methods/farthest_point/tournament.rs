//! The largest of many values that change one at a time.

/// Values that play against each other in pairs, the winners again, and so on.
pub(super) struct Tournament {
    values: Vec<f64>,
    /// The winner below each node; node 1 is the final, the last are the entrants themselves.
    winners: Vec<u32>,
    first: usize,
}

impl Tournament {
    pub fn new(values: Vec<f64>) -> Self {
        let first = values.len().next_power_of_two();
        let last = values.len() as u32 - 1;
        // Beyond the last entrant it plays for those that are missing.
        let mut winners: Vec<u32> = (0..2 * first as u32).map(|node| node.saturating_sub(first as u32).min(last)).collect();
        for node in (1..first).rev() {
            winners[node] = better(&values, winners[2 * node], winners[2 * node + 1]);
        }
        Self { values, winners, first }
    }

    /// The index of the largest value, and the value.
    pub fn best(&self) -> (usize, f64) {
        let best = self.winners[1] as usize;
        (best, self.values[best])
    }

    pub fn set(&mut self, index: usize, value: f64) {
        self.values[index] = value;
        let mut node = (self.first + index) / 2;
        while node > 0 {
            let winner = better(&self.values, self.winners[2 * node], self.winners[2 * node + 1]);
            // Where another won before and wins still, nothing changes further up.
            if self.winners[node] == winner && winner != index as u32 {
                break;
            }
            self.winners[node] = winner;
            node /= 2;
        }
    }
}

fn better(values: &[f64], a: u32, b: u32) -> u32 {
    if values[b as usize] > values[a as usize] { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Random;

    #[test]
    fn the_largest_is_always_known() {
        let mut random = Random::new(1, 0);
        for n in [1, 2, 3, 7, 64, 100] {
            let mut values = vec![0.0; n];
            let mut tournament = Tournament::new(values.clone());
            for _ in 0..500 {
                let k = (random.unit() * n as f64) as usize;
                values[k] = random.signed();
                tournament.set(k, values[k]);
                let (best, value) = tournament.best();
                assert_eq!((values[best], values.iter().copied().fold(f64::MIN, f64::max)), (value, value));
            }
        }
    }
}
