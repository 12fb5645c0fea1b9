//! Features: the creases, tips and boundaries of a surface. Creases and boundaries are chains between corners.
//!
//! Where a mesh is coarse or noisy, single edges turn as much as creases do. A crease is told from them by what stands around: its edges turn many times as much as the others
//! that end on it, and those that hang together go around something, or end at boundaries.

use glam::DVec3;

use super::Surface;
use crate::triangulation::{BOUNDARY, next, prev};

/// Where a chain turns by more than this, a corner is.
const CORNER_TURN_DEG: f64 = 45.0;
/// Creases that lead nowhere are kept only if they are longer than so many spacings; all that hang together only if they are so long in all, and on average.
const LOOSE_END: f64 = 3.0;
const LEAST_LENGTH: f64 = 4.0;
const MEAN_LENGTH: f64 = 1.2;
/// The edges of creases that hang together turn so many times as much as most others that end on them; or by so much, in degrees.
const CONTRAST: f64 = 12.0;
const CLEAR_DEG: f64 = 75.0;
/// Tips are so many spacings away from each other.
const TIPS_APART: f64 = 3.0;

/// What of a surface a mesh on it keeps.
pub(crate) struct Features {
    /// For each half-edge whether it lies on a crease or a boundary.
    pub is_crease: Vec<bool>,
    pub chains: Vec<Chain>,
    /// Vertices inside that stand out like the tip of a cone.
    pub tips: Vec<u32>,
    /// For each half-edge, the surface's normal at its origin as seen from its triangle: creases part it, all else is rounded.
    pub corner_normals: Vec<DVec3>,
}

/// Crease edges, one after the other.
pub(crate) struct Chain {
    /// From corner to corner; of a closed one without corners each vertex once.
    pub vertices: Vec<u32>,
    pub is_closed: bool,
    /// Whether one of its ends leads nowhere.
    pub is_loose: bool,
    pub is_boundary: bool,
}

impl Features {
    /// Boundaries, and where the surface turns by more than an angle, if one is given: what of that stands out in a mesh with such a spacing.
    pub fn new(surface: &Surface, angle_deg: Option<f64>, spacing: f64) -> Self {
        let least = angle_deg.unwrap_or(f64::INFINITY);
        let turns: Vec<Option<f64>> = (0..surface.half_edges.origin.len()).map(|h| surface.turn_deg(h)).collect();
        let is_crease =
            (0..turns.len()).map(|h| surface.half_edges.twin[h] == BOUNDARY || turns[h].is_some_and(|turn| turn > least)).collect();
        let mut features = Self { is_crease, chains: Vec::new(), tips: Vec::new(), corner_normals: Vec::new() };
        features.chains = chains(surface, &features.is_crease);
        if angle_deg.is_some() {
            features.prune(surface, |chain| chain.length(surface) > LOOSE_END * spacing);
            // What leads nowhere is left out for the time, and comes back where it begins at what is kept.
            let with_loose = features.is_crease.clone();
            features.prune(surface, |_| false);
            features.keep_contrast(surface, &turns, spacing);
            let is_kept: Vec<bool> = features.is_at_crease(surface);
            features.is_crease = with_loose;
            features.chains = chains(surface, &features.is_crease);
            let groups = groups(&features.chains, surface.n_vertices());
            let mut is_held = vec![false; groups.len()];
            for (chain, &group) in features.chains.iter().zip(&groups) {
                is_held[group] |= chain.vertices.iter().any(|&v| is_kept[v as usize]);
            }
            let mut group = groups.iter();
            features.retain(surface, |chain| chain.is_boundary | group.next().is_some_and(|&group| is_held[group]));
            features.keep_contrast(surface, &turns, spacing);
        }
        features.corner_normals = corner_normals(surface, &features.is_crease);
        if angle_deg.is_some() {
            features.tips = features.tips(surface, least, TIPS_APART * spacing);
            // There each triangle keeps its own normal: around a cone's tip no place faces as the tip does.
            let mut is_tip = vec![false; surface.n_vertices()];
            features.tips.iter().for_each(|&v| is_tip[v as usize] = true);
            for (h, normal) in features.corner_normals.iter_mut().enumerate() {
                if is_tip[surface.half_edges.origin[h] as usize] {
                    *normal = surface.normals[h / 3];
                }
            }
        }
        features
    }

    /// Boundaries alone.
    pub fn boundaries(surface: &Surface) -> Self {
        Self::new(surface, None, 0.0)
    }

    /// The surface's normal at each vertex: the mean of its sectors'.
    pub fn vertex_normals(&self, surface: &Surface) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; surface.n_vertices()];
        for (&v, &normal) in surface.half_edges.origin.iter().zip(&self.corner_normals) {
            normals[v as usize] += normal;
        }
        normals.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// Leaves out chains that lead nowhere, as often as that makes others loose, but for those that one says yes to.
    fn prune(&mut self, surface: &Surface, is_kept: impl Fn(&Chain) -> bool) {
        loop {
            let n = self.chains.len();
            self.retain(surface, |chain| !chain.is_loose || chain.is_boundary || is_kept(chain));
            if self.chains.len() == n {
                return;
            }
        }
    }

    /// Leaves out the creases that hang together but do not stand out, or are short.
    fn keep_contrast(&mut self, surface: &Surface, turns: &[Option<f64>], spacing: f64) {
        let groups = groups(&self.chains, surface.n_vertices());
        let n_groups = groups.iter().max().map_or(0, |&group| group + 1);
        let mut group_of = vec![usize::MAX; surface.n_vertices()];
        let (mut lengths, mut n_chains) = (vec![0.0; n_groups], vec![0.0; n_groups]);
        for (chain, &group) in self.chains.iter().zip(&groups).filter(|(chain, _)| !chain.is_boundary) {
            lengths[group] += chain.length(surface);
            n_chains[group] += 1.0;
            chain.vertices.iter().for_each(|&v| group_of[v as usize] = group);
        }
        let (mut sharp, mut others) = (vec![Vec::new(); n_groups], vec![Vec::new(); n_groups]);
        for (h, turn) in turns.iter().enumerate() {
            let group = group_of[surface.half_edges.origin[h] as usize];
            if let Some(turn) = turn.filter(|_| group != usize::MAX) {
                let list = if self.is_crease[h] { &mut sharp } else { &mut others };
                list[group].push(turn);
            }
        }
        let mut stands_out =
            sharp.iter_mut().zip(&mut others).map(|(sharp, others)| median(sharp) > CLEAR_DEG.min(CONTRAST * median(others)));
        let is_long = |(length, n): (&f64, &f64)| *length > LEAST_LENGTH.max(MEAN_LENGTH * n) * spacing;
        let is_kept: Vec<bool> = lengths.iter().zip(&n_chains).map(|group| is_long(group) & (stands_out.next() == Some(true))).collect();
        let mut group = groups.iter();
        self.retain(surface, |chain| chain.is_boundary | group.next().is_some_and(|&group| is_kept[group]));
    }

    /// For each vertex whether it lies on a crease that is no boundary.
    fn is_at_crease(&self, surface: &Surface) -> Vec<bool> {
        let mut is = vec![false; surface.n_vertices()];
        for chain in self.chains.iter().filter(|chain| !chain.is_boundary) {
            chain.vertices.iter().for_each(|&v| is[v as usize] = true);
        }
        is
    }

    /// Vertices off the creases whose angles miss more than `least` degrees of a full turn, the sharpest first, so far apart.
    fn tips(&self, surface: &Surface, least: f64, apart: f64) -> Vec<u32> {
        let mut missing = vec![360.0; surface.n_vertices()];
        for h in 0..self.is_crease.len() as u32 {
            let missing: &mut f64 = &mut missing[surface.half_edges.origin[h as usize] as usize];
            *missing -= if self.is_crease[h as usize] || self.is_crease[prev(h) as usize] { 360.0 } else { surface.angle(h).to_degrees() };
        }
        let is_used = surface.half_edges.outgoing(surface.n_vertices()).into_iter().map(|h| h != BOUNDARY);
        let mut tips: Vec<u32> =
            (0..).zip(is_used).filter(|&(v, is_used)| is_used && missing[v as usize] > least).map(|(v, _)| v).collect();
        tips.sort_by(|&a, &b| missing[b as usize].total_cmp(&missing[a as usize]).then(a.cmp(&b)));
        let at = |v: u32| surface.points[v as usize];
        let on_creases: Vec<u32> = self.chains.iter().flat_map(|chain| chain.vertices.iter().copied()).collect();
        let mut kept: Vec<u32> = Vec::new();
        for v in tips {
            if kept.iter().chain(&on_creases).all(|&other| at(other).distance(at(v)) > apart) {
                kept.push(v);
            }
        }
        kept
    }

    /// Without the chains that one says no to.
    fn retain(&mut self, surface: &Surface, mut is_kept: impl FnMut(&Chain) -> bool) {
        let mesh = &surface.half_edges;
        let outgoing = mesh.outgoing(surface.n_vertices());
        let mut has_changed = false;
        for chain in self.chains.iter().filter(|chain| !is_kept(chain)) {
            for (a, b) in chain.steps() {
                for h in mesh.around(outgoing[a as usize]) {
                    // The edge may leave `a`, or arrive there.
                    for h in [h, prev(h)] {
                        let twin = mesh.twin[h as usize];
                        let is_step =
                            [mesh.origin[h as usize], mesh.target(h)] == [a, b] || [mesh.target(h), mesh.origin[h as usize]] == [a, b];
                        if is_step && twin != BOUNDARY {
                            (self.is_crease[h as usize], self.is_crease[twin as usize]) = (false, false);
                            has_changed = true;
                        }
                    }
                }
            }
        }
        if has_changed {
            self.chains = chains(surface, &self.is_crease);
        }
    }
}

impl Chain {
    /// Its edges, each by its ends.
    pub fn steps(&self) -> impl Iterator<Item = (u32, u32)> {
        let closing = self.is_closed.then(|| (self.vertices[self.vertices.len() - 1], self.vertices[0]));
        self.vertices.windows(2).map(|pair| (pair[0], pair[1])).chain(closing)
    }

    /// How long it is, inside.
    pub fn length(&self, surface: &Surface) -> f64 {
        self.steps().map(|(a, b)| surface.points[a as usize].distance(surface.points[b as usize])).sum()
    }
}

impl Surface {
    /// The angle in degrees by which the surface turns at an edge; `None` on a boundary, and where a triangle has no area.
    fn turn_deg(&self, h: usize) -> Option<f64> {
        let twin = self.half_edges.twin[h];
        let normals = (twin != BOUNDARY).then(|| [self.normals[h / 3], self.normals[twin as usize / 3]])?;
        let [a, b] = normals;
        (a != DVec3::ZERO && b != DVec3::ZERO).then(|| libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees())
    }
}

/// Of each chain the number of the group of those that hang together; boundaries stand alone.
fn groups(chains: &[Chain], n_vertices: usize) -> Vec<usize> {
    let mut root: Vec<usize> = (0..chains.len()).collect();
    fn find(root: &mut [usize], mut k: usize) -> usize {
        while root[k] != k {
            root[k] = root[root[k]];
            k = root[k];
        }
        k
    }
    let mut first_at = vec![usize::MAX; n_vertices];
    for (k, chain) in chains.iter().enumerate().filter(|(_, chain)| !chain.is_boundary) {
        for end in [chain.vertices[0], chain.vertices[chain.vertices.len() - 1]] {
            let first = &mut first_at[end as usize];
            if *first == usize::MAX {
                *first = k;
            } else {
                let (a, b) = (find(&mut root, *first), find(&mut root, k));
                root[a.max(b)] = a.min(b);
            }
        }
    }
    (0..chains.len()).map(|k| find(&mut root, k)).collect()
}

/// The middle one of some numbers; 0 of none.
fn median(numbers: &mut [f64]) -> f64 {
    if numbers.is_empty() {
        return 0.0;
    }
    let middle = numbers.len() / 2;
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The ends of the creases at each vertex, each edge once.
fn creases_at(surface: &Surface, is_crease: &[bool]) -> Vec<Vec<u32>> {
    let mesh = &surface.half_edges;
    let mut ends = vec![Vec::new(); surface.n_vertices()];
    for h in (0..is_crease.len() as u32).filter(|&h| is_crease[h as usize] && (mesh.is_boundary(h) || h < mesh.twin[h as usize])) {
        let [a, b] = [mesh.origin[h as usize], mesh.target(h)];
        ends[a as usize].push(b);
        ends[b as usize].push(a);
    }
    ends
}

fn chains(surface: &Surface, is_crease: &[bool]) -> Vec<Chain> {
    let ends = creases_at(surface, is_crease);
    let least_cos = libm::cos(CORNER_TURN_DEG.to_radians());
    let is_corner = |v: usize| match ends[v][..] {
        [a, b] => {
            let way = |to: u32| (surface.points[to as usize] - surface.points[v]).normalize_or_zero();
            -way(a).dot(way(b)) < least_cos
        }
        _ => true,
    };
    let mut used: Vec<Vec<bool>> = ends.iter().map(|ends| vec![false; ends.len()]).collect();
    let mut walk = |from: usize, k: usize| -> Option<Vec<u32>> {
        if used[from][k] {
            return None;
        }
        let mut vertices = vec![from as u32];
        let (mut at, mut k) = (from, k);
        loop {
            used[at][k] = true;
            let to = ends[at][k] as usize;
            let back = (0..ends[to].len()).find(|&back| ends[to][back] == at as u32 && !used[to][back])?;
            used[to][back] = true;
            vertices.push(to as u32);
            if to == from || is_corner(to) {
                return Some(vertices);
            }
            (at, k) = (to, usize::from(back == 0));
        }
    };
    let outgoing = surface.half_edges.outgoing(surface.n_vertices());
    let is_boundary = |a: u32, b: u32| {
        let mut around = surface.half_edges.around(outgoing[a as usize]).flat_map(|h| [h, prev(h)]);
        around.any(|h| {
            let ends = [surface.half_edges.origin[h as usize], surface.half_edges.target(h)];
            (ends == [a, b] || ends == [b, a]) && surface.half_edges.is_boundary(h)
        })
    };
    let mut chains = Vec::new();
    for v in (0..ends.len()).filter(|&v| !ends[v].is_empty() && is_corner(v)) {
        for k in 0..ends[v].len() {
            if let Some(vertices) = walk(v, k) {
                let is_loose = [vertices[0], vertices[vertices.len() - 1]].iter().any(|&end| ends[end as usize].len() == 1);
                chains.push(Chain { is_boundary: is_boundary(vertices[0], vertices[1]), vertices, is_closed: false, is_loose });
            }
        }
    }
    // What is left are loops.
    for v in (0..ends.len()).filter(|&v| ends[v].len() == 2 && !is_corner(v)) {
        if let Some(mut vertices) = walk(v, 0) {
            vertices.pop();
            chains.push(Chain { is_boundary: is_boundary(vertices[0], vertices[1]), vertices, is_closed: true, is_loose: false });
        }
    }
    chains
}

/// The mean of the normals in each sector between creases, weighted by angles.
fn corner_normals(surface: &Surface, is_crease: &[bool]) -> Vec<DVec3> {
    let mesh = &surface.half_edges;
    let mut normals = vec![DVec3::ZERO; is_crease.len()];
    let mut is_done = vec![false; is_crease.len()];
    let mut sector = Vec::new();
    for h in 0..is_crease.len() as u32 {
        if is_done[h as usize] {
            continue;
        }
        // Clockwise to a crease, if there is one, and from there on.
        let mut first = h;
        while !is_crease[first as usize] {
            first = next(mesh.twin[first as usize]);
            if first == h {
                break;
            }
        }
        sector.clear();
        let mut at = first;
        let mut sum = DVec3::ZERO;
        loop {
            sector.push(at);
            sum += surface.angle(at) * surface.normals[at as usize / 3];
            let last = prev(at);
            if is_crease[last as usize] {
                break;
            }
            at = mesh.twin[last as usize];
            if at == first {
                break;
            }
        }
        let normal = sum.normalize_or_zero();
        for &at in &sector {
            (normals[at as usize], is_done[at as usize]) = (normal, true);
        }
    }
    normals
}
