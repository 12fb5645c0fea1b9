//! Values of flags that several verbs read the same way.

use evenly::{MAX_POINTS, Setting};
use evenly_io::Format;

/// A number of points.
pub fn parse_count(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok().or_else(|| {
        // 1e6 is a count too.
        let number = text.parse::<f64>().ok()?;
        (number.fract() == 0.0 && (0.0..1e15).contains(&number)).then_some(number as usize)
    });
    match number {
        Some(n) if (1..=MAX_POINTS).contains(&n) => Ok(n),
        _ => Err(format!("it must be a whole number from 1 to {MAX_POINTS}")),
    }
}

/// A length in input units, which have no name: `5` or `5u`.
pub fn parse_length(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(Setting::Number(length) | Setting::Length(length)) => Ok(length),
        Ok(_) => Err("it must be a number".into()),
        Err(_) if text.starts_with(|c: char| c.is_ascii_digit()) => {
            Err("inputs have no units: it must be a number alone, in the input's own".into())
        }
        Err(why) => Err(why),
    }
}

/// A format by its name.
pub fn parse_format(text: &str) -> Result<Format, String> {
    let names: Vec<&str> = Format::ALL.iter().map(|&(name, _)| name).collect();
    Format::from_name(text).ok_or_else(|| format!("it must be one of {}", names.join(", ")))
}

/// A length in millimetres, or with a unit.
pub fn parse_mm(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let units = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)];
    let (number, unit) = units.iter().find_map(|&(name, mm)| Some((text.strip_suffix(name)?, mm))).unwrap_or((text, 1.0));
    let length = number.trim().parse::<f64>().map_or(f64::NAN, |number| number * unit);
    if (0.0..=1e5).contains(&length) { Ok(length) } else { Err("it must be a length, such as 10mm, 1cm or 0.5in, 100 m at most".into()) }
}
