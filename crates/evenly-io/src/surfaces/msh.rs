//! Gmsh's meshes, 2.2 and 4.1, as text: nodes, triangles and quadrangles.

use std::collections::HashMap;
use std::str::SplitWhitespace;

use super::TrianglesRead;
use super::building::Building;
use crate::Error;

/// Kinds of elements: their number in the format, and their nodes, of which the corners come first.
const TRIANGLE: usize = 2;
const QUADRANGLE: usize = 3;

/// The words of a file.
struct Words<'a> {
    name: &'a str,
    words: SplitWhitespace<'a>,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Result<&'a str, Error> {
        self.words.next().ok_or_else(|| Error::content(self.name, "it ends too early"))
    }

    fn number<T: std::str::FromStr>(&mut self) -> Result<T, Error> {
        let word = self.next()?;
        word.parse().map_err(|_| Error::content(self.name, format!("{word:?} is not the number that must stand there")))
    }

    fn numbers<const N: usize>(&mut self) -> Result<[usize; N], Error> {
        let mut numbers = [0; N];
        for number in &mut numbers {
            *number = self.number()?;
        }
        Ok(numbers)
    }
}

/// Where the words of a section begin.
fn section<'a>(name: &'a str, text: &'a str, title: &str) -> Result<Words<'a>, Error> {
    let begin = text.lines().find(|line| line.trim_end() == title);
    let begin = begin.ok_or_else(|| Error::content(name, format!("it has no section {title}")))?;
    let at = begin.as_ptr() as usize - text.as_ptr() as usize + begin.len();
    Ok(Words { name, words: text[at..].split_whitespace() })
}

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let text = String::from_utf8_lossy(bytes);
    let mut format = section(name, &text, "$MeshFormat")?;
    let (version, is_binary): (f64, usize) = (format.number()?, format.number()?);
    if is_binary != 0 {
        return Err(Error::content(name, "it is binary; save it as text (Mesh.Binary = 0)"));
    }
    let mut building = Building::default();
    let mut vertices = HashMap::new();
    let (nodes, elements) = (section(name, &text, "$Nodes")?, section(name, &text, "$Elements")?);
    let n_others = if version >= 4.1 {
        read_nodes_4(nodes, &mut building, &mut vertices)?;
        read_elements_4(elements, &mut building, &vertices)?
    } else if (2.0..3.0).contains(&version) {
        read_nodes_2(nodes, &mut building, &mut vertices)?;
        read_elements_2(elements, &mut building, &vertices)?
    } else {
        return Err(Error::content(name, format!("its version is {version}; 2.2 and 4.1 are read")));
    };
    if n_others > 0 {
        building.notes.push(format!("{n_others} elements of three dimensions or of higher order were left out"));
    }
    building.finish(name, |number| format!("{name}: element {number}"))
}

fn push_node(words: &mut Words, tag: usize, building: &mut Building, vertices: &mut HashMap<usize, usize>) -> Result<(), Error> {
    let position = [words.number()?, words.number()?, words.number()?];
    vertices.insert(tag, building.mesh.vertices.len());
    building.push_vertex(position, || format!("node {tag}"));
    Ok(())
}

fn read_nodes_4(mut words: Words, building: &mut Building, vertices: &mut HashMap<usize, usize>) -> Result<(), Error> {
    let [n_blocks, ..] = words.numbers::<4>()?;
    for _ in 0..n_blocks {
        let dimension: usize = words.number()?;
        let [_, is_parametric, n] = words.numbers()?;
        let mut tags = Vec::new();
        for _ in 0..n {
            tags.push(words.number()?);
        }
        for tag in tags {
            push_node(&mut words, tag, building, vertices)?;
            for _ in 0..is_parametric * dimension {
                words.next()?;
            }
        }
    }
    Ok(())
}

fn read_nodes_2(mut words: Words, building: &mut Building, vertices: &mut HashMap<usize, usize>) -> Result<(), Error> {
    let n: usize = words.number()?;
    for _ in 0..n {
        let tag = words.number()?;
        push_node(&mut words, tag, building, vertices)?;
    }
    Ok(())
}

/// Adds an element's triangles. Whether it is one that has none, but more than a line.
fn push_element(
    words: &mut Words,
    [tag, kind]: [usize; 2],
    building: &mut Building,
    vertices: &HashMap<usize, usize>,
) -> Result<bool, Error> {
    let name = words.name;
    let n_corners = match kind {
        TRIANGLE => 3,
        QUADRANGLE => 4,
        _ => {
            for _ in 0..n_nodes(kind).ok_or_else(|| Error::content(name, format!("element {tag} is of kind {kind}, which is not read")))? {
                words.next()?;
            }
            // Points and lines bound what is read.
            return Ok(![1, 8, 15].contains(&kind));
        }
    };
    let mut corners = Vec::with_capacity(n_corners);
    for _ in 0..n_corners {
        let node = words.number()?;
        let vertex =
            vertices.get(&node).ok_or_else(|| Error::content(name, format!("element {tag} has node {node}, which is not there")))?;
        corners.push(*vertex);
    }
    building.push_face(&corners, tag).map_err(|problem| Error::content(name, format!("element {tag}: {problem}")))?;
    Ok(false)
}

fn read_elements_4(mut words: Words, building: &mut Building, vertices: &HashMap<usize, usize>) -> Result<usize, Error> {
    let [n_blocks, ..] = words.numbers::<4>()?;
    let mut n_others = 0;
    for _ in 0..n_blocks {
        words.next()?;
        let [_, kind, n] = words.numbers()?;
        for _ in 0..n {
            let tag = words.number()?;
            n_others += usize::from(push_element(&mut words, [tag, kind], building, vertices)?);
        }
    }
    Ok(n_others)
}

fn read_elements_2(mut words: Words, building: &mut Building, vertices: &HashMap<usize, usize>) -> Result<usize, Error> {
    let n: usize = words.number()?;
    let mut n_others = 0;
    for _ in 0..n {
        let [tag, kind, n_tags] = words.numbers()?;
        for _ in 0..n_tags {
            words.next()?;
        }
        n_others += usize::from(push_element(&mut words, [tag, kind], building, vertices)?);
    }
    Ok(n_others)
}

/// How many nodes an element of another kind has.
fn n_nodes(kind: usize) -> Option<usize> {
    // Line, tetrahedron, hexahedron, prism, pyramid; of second order line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid; point; others of second order.
    const NODES: [(usize, usize); 17] = [
        (1, 2),
        (4, 4),
        (5, 8),
        (6, 6),
        (7, 5),
        (8, 3),
        (9, 6),
        (10, 9),
        (11, 10),
        (12, 27),
        (13, 18),
        (14, 14),
        (15, 1),
        (16, 8),
        (17, 20),
        (18, 15),
        (19, 13),
    ];
    NODES.iter().find(|(known, _)| *known == kind).map(|&(_, n)| n)
}
