//! Points as a numpy array of shape (n, 2).

use npyz::{NpyFile, Order, WriterBuilder as _};

use crate::Error;

/// Reads points from the bytes of the `.npy` file `name`: floats and integers, either order.
pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 2]>, Error> {
    let ([n_rows, n_columns], numbers) = read_table(name, bytes)?;
    if n_columns != 2 {
        return Err(Error::content(name, format!("its shape is [{n_rows}, {n_columns}], expected (n, 2)")));
    }
    if n_rows == 0 {
        return Err(Error::content(name, "there are no points in it"));
    }
    let points = numbers.as_chunks::<2>().0.to_vec();
    match points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        Some(row) => Err(Error::content(name, format!("row {row} is ({}, {}), which is not finite", points[row][0], points[row][1]))),
        None => Ok(points),
    }
}

/// Reads rows of numbers: how many, of how many columns, and the numbers row by row.
pub(crate) fn read_table(name: &str, bytes: &[u8]) -> Result<([usize; 2], Vec<f64>), Error> {
    let problem = |text: String| Error::content(name, text);
    let file = NpyFile::new(bytes).map_err(|e| problem(format!("this is no .npy file: {e}")))?;
    let &[n_rows, n_columns] = file.shape() else {
        return Err(problem(format!("its shape is {:?}, expected (n, 2)", file.shape())));
    };
    if n_rows.saturating_mul(n_columns) > bytes.len() as u64 {
        return Err(problem(format!("its header promises {n_rows} points, but the file is too short")));
    }
    let shape = [n_rows as usize, n_columns as usize];
    let order = file.order();
    let kind = file.dtype().descr();
    let cut_short = |e: std::io::Error| problem(format!("it cannot be read to its end: {e}"));
    macro_rules! numbers {
        ($of:ty) => {
            file.into_vec::<$of>().map_err(cut_short)?.into_iter().map(|number| number as f64).collect()
        };
    }
    let numbers: Vec<f64> = match kind.trim_matches(|c: char| !c.is_ascii_alphanumeric()) {
        "f8" => numbers!(f64),
        "f4" => numbers!(f32),
        "i8" => numbers!(i64),
        "i4" => numbers!(i32),
        "i2" => numbers!(i16),
        "i1" => numbers!(i8),
        "u8" => numbers!(u64),
        "u4" => numbers!(u32),
        "u2" => numbers!(u16),
        "u1" => numbers!(u8),
        _ => return Err(problem(format!("its numbers are {kind}, expected floats or integers of 8 to 64 bits"))),
    };
    let [n_rows, n_columns] = shape;
    Ok((
        shape,
        match order {
            Order::C => numbers,
            Order::Fortran => (0..n_rows * n_columns).map(|k| numbers[k % n_columns * n_rows + k / n_columns]).collect(),
        },
    ))
}

/// Writes float64 in C order.
pub(crate) fn write(points: &[[f64; 2]]) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(16 * points.len() + 128);
    let shape = [points.len() as u64, 2];
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut bytes).begin_nd()?;
    writer.extend(points.iter().flatten())?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_survives_writing_and_reading() {
        let points = vec![[0.1, -2.5], [1e300, f64::MIN_POSITIVE], [3.0, 4.0]];
        assert_eq!(read("p.npy", &write(&points).unwrap()).unwrap(), points);
    }

    #[test]
    fn broken_arrays_are_named() {
        let whole = write(&[[1.0, 2.0], [3.0, 4.0]]).unwrap();
        let message = |bytes: &[u8]| read("p.npy", bytes).unwrap_err().to_string();
        assert!(message(&whole[..whole.len() - 4]).starts_with("p.npy: it cannot be read to its end"));
        assert!(message(b"1 2\n3 4\n").starts_with("p.npy: this is no .npy file"));
        assert!(message(&write(&[]).unwrap()).ends_with("there are no points in it"));
        assert!(message(&write(&[[1.0, f64::NAN]]).unwrap()).starts_with("p.npy: row 0 is (1, NaN)"));
    }
}
