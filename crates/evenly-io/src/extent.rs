//! [`Extent`]: the domain of points, as their files carry it in a comment.

use std::fmt;

use evenly::{Rectangle, Space, Torus};

/// A torus or a rectangle. As words: `domain: torus 0 0 640 480`, the lower left corner, then width and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Whether it is a torus.
    pub is_periodic: bool,
    /// Its lower left corner.
    pub origin: [f64; 2],
    /// Width and height.
    pub size: [f64; 2],
}

/// What the words begin with.
const DOMAIN: &str = "domain: ";
/// The words stand among so many first bytes of a file.
const HEAD: usize = 4096;

impl Extent {
    /// That of a space; a polygon has none.
    pub fn of(space: &Space) -> Option<Self> {
        space.region().is_none().then(|| Self { is_periodic: space.is_periodic(), origin: space.origin(), size: space.size() })
    }

    /// The space.
    ///
    /// # Errors
    /// As [`Torus::new`].
    pub fn space(&self) -> Result<Space, evenly::Error> {
        let Self { is_periodic, origin, size } = *self;
        Ok(if is_periodic { Torus::new(origin, size)?.into() } else { Rectangle::new(origin, size)?.into() })
    }

    /// What a file says of its domain.
    pub(crate) fn find(bytes: &[u8]) -> Option<Self> {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
        let (_, words) = head.split_once(DOMAIN)?;
        let end = words.find(|c: char| !(c.is_ascii_alphanumeric() || " .+-".contains(c))).unwrap_or(words.len());
        let words: Vec<&str> = words[..end].split(' ').collect();
        let [kind @ ("torus" | "rectangle"), numbers @ ..] = &words[..] else { return None };
        let numbers: Vec<f64> = numbers.iter().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        let [x, y, width, height] = numbers[..] else { return None };
        let extent = Self { is_periodic: *kind == "torus", origin: [x, y], size: [width, height] };
        extent.space().is_ok().then_some(extent)
    }
}

impl fmt::Display for Extent {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { is_periodic, origin: [x, y], size: [width, height] } = self;
        write!(f, "{DOMAIN}{} {x} {y} {width} {height}", if *is_periodic { "torus" } else { "rectangle" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_extent_comes_back_from_a_file() {
        for is_periodic in [true, false] {
            let extent = Extent { is_periodic, origin: [-1e9, 0.1], size: [640.0, 1.5] };
            assert_eq!(Extent::find(format!("# evenly\n# {extent}\n1 2\n").as_bytes()), Some(extent));
            assert_eq!(Extent::find(format!("{{\"generator\":\"evenly\\n{extent}\",\"features\":[]}}").as_bytes()), Some(extent));
        }
        for text in [
            "",
            "# domain: torus",
            "# domain: torus 0 0 1",
            "# domain: disk 0 0 1 1",
            "# domain: torus 0 0 -1 1",
            "# domain: torus 0 0 1 x",
        ] {
            assert_eq!(Extent::find(text.as_bytes()), None, "{text}");
        }
    }
}
