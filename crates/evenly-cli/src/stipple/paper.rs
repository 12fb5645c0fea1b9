//! The paper, and where on it the picture lies.

use anyhow::bail;

use crate::parse::parse_mm;

/// A page with a picture in its middle, as large as the margins leave room for.
pub struct Paper {
    pub size_mm: [f64; 2],
    /// Of the picture's upper left corner.
    corner_mm: [f64; 2],
    /// Of the picture, in pixels.
    height_px: f64,
    pub mm_per_px: f64,
}

/// Sheets by name, upright, in millimetres.
const SHEETS: [(&str, [f64; 2]); 8] = [
    ("a0", [841.0, 1189.0]),
    ("a1", [594.0, 841.0]),
    ("a2", [420.0, 594.0]),
    ("a3", [297.0, 420.0]),
    ("a4", [210.0, 297.0]),
    ("a5", [148.0, 210.0]),
    ("a6", [105.0, 148.0]),
    ("letter", [215.9, 279.4]),
];

impl Paper {
    /// Lays a picture of this size in pixels on a page.
    ///
    /// # Errors
    /// An unknown page, or one without room inside its margins.
    pub fn new(page: &str, margin_mm: f64, picture: [usize; 2]) -> anyhow::Result<Self> {
        let [width, height] = picture.map(|n| n as f64);
        let size_mm = match SHEETS.iter().find(|(name, _)| page.eq_ignore_ascii_case(name)) {
            Some(&(_, [short, long])) if width > height => [long, short],
            Some(&(_, upright)) => upright,
            None => parse_size(page)?,
        };
        let room = size_mm.map(|side| side - 2.0 * margin_mm);
        if !(room[0] > 0.0 && room[1] > 0.0) {
            bail!("--page {} x {} mm has no room inside margins of {margin_mm} mm", size_mm[0], size_mm[1]);
        }
        let mm_per_px = (room[0] / width).min(room[1] / height);
        let corner_mm = [0.5 * (size_mm[0] - width * mm_per_px), 0.5 * (size_mm[1] - height * mm_per_px)];
        Ok(Self { size_mm, corner_mm, height_px: height, mm_per_px })
    }

    /// Where a place in the picture is on the page, from its top left corner; the picture's y goes upwards.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.corner_mm[0] + x * self.mm_per_px, self.corner_mm[1] + (self.height_px - y) * self.mm_per_px]
    }
}

/// Width and height with an x between them, and one unit after both or each.
fn parse_size(page: &str) -> anyhow::Result<[f64; 2]> {
    let unknown = || anyhow::anyhow!("--page {page}: it must be a0 to a6, letter, or a size such as 300x200mm");
    let (width, height) = page.split_once(['x', 'X']).ok_or_else(unknown)?;
    let unit = height.trim_start_matches(|c: char| c.is_ascii_digit() || ".+- ".contains(c));
    let width = if width.ends_with(|c: char| c.is_ascii_digit()) { format!("{width}{unit}") } else { width.to_owned() };
    match (parse_mm(&width), parse_mm(height)) {
        (Ok(width), Ok(height)) if width > 0.0 && height > 0.0 => Ok([width, height]),
        _ => Err(unknown()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_lies_in_the_middle_of_its_page_as_large_as_it_can() {
        let paper = Paper::new("a4", 10.0, [400, 200]).unwrap();
        assert_eq!(paper.size_mm, [297.0, 210.0]);
        assert!((paper.mm_per_px - 277.0 / 400.0).abs() < 1e-12);
        assert_eq!(paper.place([0.0, 200.0]), [10.0, 0.5 * (210.0 - 138.5)]);
        assert_eq!(paper.place([400.0, 0.0])[0], 287.0);
        assert_eq!(Paper::new("A4", 0.0, [1, 1]).unwrap().size_mm, [210.0, 297.0]);
    }

    #[test]
    fn pages_have_names_or_sizes_with_units() {
        let size = |page| Paper::new(page, 0.0, [9, 1]).map(|paper| paper.size_mm).ok();
        assert_eq!(size("300x200mm"), Some([300.0, 200.0]));
        assert_eq!(size("300 x 200"), Some([300.0, 200.0]));
        assert_eq!(size("8inx10in"), Some([203.2, 254.0]));
        assert_eq!(size("30x20cm"), Some([300.0, 200.0]));
        assert_eq!(size("letter"), Some([279.4, 215.9]));
        for bad in ["", "a7", "x", "10", "10x", "0x10mm", "-1x10", "1x2x3", "nanxnan"] {
            assert_eq!(size(bad), None, "{bad}");
        }
        assert!(Paper::new("20x20mm", 10.0, [9, 1]).is_err());
    }
}
