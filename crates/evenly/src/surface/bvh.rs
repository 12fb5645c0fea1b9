//! [`Bvh`]: boxes in boxes, for what is near in space whatever lies between.

use glam::DVec3;

/// Items in a leaf at most.
const LEAF: usize = 4;

#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    pub fn of(points: &[DVec3]) -> Self {
        let (low, high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        points.iter().fold(Self { low, high }, |all, &p| Self { low: all.low.min(p), high: all.high.max(p) })
    }

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub fn meets(self, other: Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    fn distance_squared(self, p: DVec3) -> f64 {
        p.clamp(self.low, self.high).distance_squared(p)
    }
}

/// A tree over items that have bounds.
pub(super) struct Bvh {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

struct Node {
    bounds: Bounds,
    /// Of a leaf its items; of others the second child, while the first follows its parent.
    first: u32,
    /// 0 for a node with children.
    n_items: u32,
}

impl Bvh {
    pub fn new(bounds: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(bounds.len()), items: (0..bounds.len() as u32).collect() };
        if !bounds.is_empty() {
            tree.build(bounds, 0, bounds.len());
        }
        tree
    }

    fn build(&mut self, bounds: &[Bounds], begin: usize, end: usize) {
        let middle = |item: u32| bounds[item as usize].low + bounds[item as usize].high;
        let items = &mut self.items[begin..end];
        let all = items[1..].iter().fold(bounds[items[0] as usize], |all, &item| all.with(bounds[item as usize]));
        let node = self.nodes.len();
        let n_items = items.len();
        self.nodes.push(Node { bounds: all, first: begin as u32, n_items: if n_items > LEAF { 0 } else { n_items as u32 } });
        if n_items > LEAF {
            let middles: Vec<DVec3> = items.iter().map(|&item| middle(item)).collect();
            let Bounds { low, high } = Bounds::of(&middles);
            let axis = (high - low).max_position();
            items.select_nth_unstable_by(n_items / 2, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
            let half = begin + n_items / 2;
            self.build(bounds, begin, half);
            self.nodes[node].first = self.nodes.len() as u32;
            self.build(bounds, half, end);
        }
    }

    /// The item nearest to a place, of those the square of whose distance is below `most`, and that square; `distance_squared` tells that of an item.
    pub fn nearest(&self, p: DVec3, most: f64, distance_squared: impl Fn(u32) -> f64) -> Option<(u32, f64)> {
        let mut best = (None, most);
        let mut stack = vec![(0usize, 0.0)];
        while let Some((at, bound)) = stack.pop() {
            let Some(node) = self.nodes.get(at).filter(|_| bound < best.1) else { continue };
            if node.n_items > 0 {
                for &item in &self.items[node.first as usize..(node.first + node.n_items) as usize] {
                    let distance = distance_squared(item);
                    if distance < best.1 {
                        best = (Some(item), distance);
                    }
                }
                continue;
            }
            let [a, b] = [at + 1, node.first as usize].map(|child| (child, self.nodes[child].bounds.distance_squared(p)));
            let (near, far) = if a.1 <= b.1 { (a, b) } else { (b, a) };
            stack.extend([far, near]);
        }
        best.0.map(|item| (item, best.1))
    }

    /// For each node the group to which all of its items belong, if it is one.
    pub fn groups(&self, of_items: &[u32]) -> Vec<Option<u32>> {
        let mut groups = vec![None; self.nodes.len()];
        // Children come after their parents.
        for (at, node) in self.nodes.iter().enumerate().rev() {
            groups[at] = if node.n_items > 0 {
                let items = &self.items[node.first as usize..(node.first + node.n_items) as usize];
                let group = of_items[items[0] as usize];
                items.iter().all(|&item| of_items[item as usize] == group).then_some(group)
            } else {
                groups[at + 1].filter(|_| groups[at + 1] == groups[node.first as usize])
            };
        }
        groups
    }

    /// Shows all items whose boxes meet a box, but for those of nodes that are left out.
    pub fn meeting(&self, bounds: Bounds, is_left_out: impl Fn(usize) -> bool, mut show: impl FnMut(u32)) {
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            let is_asked = |node: &&Node| node.bounds.meets(bounds) && !is_left_out(at);
            let Some(node) = self.nodes.get(at).filter(is_asked) else { continue };
            if node.n_items > 0 {
                self.items[node.first as usize..(node.first + node.n_items) as usize].iter().for_each(|&item| show(item));
            } else {
                stack.extend([node.first as usize, at + 1]);
            }
        }
    }
}
