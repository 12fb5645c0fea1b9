//! What can be wrong with an input. "Did not converge" is not here: that is data, in the `Report`.

use thiserror::Error;

/// An input that cannot be worked with. Every message names the value and the way out.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A coordinate is NaN or infinite.
    #[error("point {index} is ({}, {}), which is not finite", point[0], point[1])]
    NotFinite {
        /// Index of the first such point.
        index: usize,
        /// The point as it was given.
        point: [f64; 2],
    },
    /// A point lies outside a bounded domain.
    #[error(
        "point {index} is ({}, {}), outside the domain {domain}; \
         it must hold every point", point[0], point[1]
    )]
    OutsideDomain {
        /// Index of the first such point.
        index: usize,
        /// The point as it was given.
        point: [f64; 2],
        /// The domain, for the message.
        domain: String,
    },
    /// A size or an origin that makes no domain.
    #[error("{0}")]
    InvalidSpace(String),
    /// A parameter outside its range.
    #[error("{name} is {value}; it must be {expected}")]
    InvalidParameter {
        /// The parameter's name, as in the struct that holds it.
        name: &'static str,
        /// The value as it was given.
        value: String,
        /// What it should have been.
        expected: &'static str,
    },
    /// A parameter that the method does not have.
    #[error("{method} has no parameter {name}")]
    UnknownParameter {
        /// The parameter's name.
        name: String,
        /// The method's.
        method: &'static str,
    },
    /// A method that improves points was asked to make some.
    #[error("{method} improves points, and makes none of its own")]
    NoStart {
        /// The method's name.
        method: &'static str,
    },
    /// What is needed was not given.
    #[error("{} is missing: {question}", names.join(" or "))]
    Missing {
        /// The names of what was not given; one of them is enough.
        names: &'static [&'static str],
        /// What is not known without it.
        question: &'static str,
    },
    /// Two parameters were given of which one alone can be followed.
    #[error("{} and {} exclude each other: {why}", names[0], names[1])]
    Excluded {
        /// Their names.
        names: [&'static str; 2],
        /// The reason.
        why: &'static str,
    },
    /// The domain is so far from zero, or the points so many, that f64 cannot tell neighbours apart.
    #[error(
        "{n_points} points in {domain} are {spacing:e} apart, but numbers that large are only {resolution:e} apart; \
         move the origin nearer to 0"
    )]
    TooFine {
        /// How many points were asked for.
        n_points: usize,
        /// The domain, for the message.
        domain: String,
        /// The mean spacing, in input units.
        spacing: f64,
        /// The distance between neighbouring f64 at the domain's far end.
        resolution: f64,
    },
    /// More points than the indices can hold.
    #[error("{0} points are too many; at most {1} are possible")]
    TooManyPoints(usize, usize),
    /// A boundary that encloses no domain, or leaves in doubt which.
    #[error("the polygon {problem}, at ({}, {})", at[0], at[1])]
    InvalidPolygon {
        /// What is wrong with it.
        problem: String,
        /// Where, in input units.
        at: [f64; 2],
    },
    /// What was to be kept in a mesh, and lies outside.
    #[error("the polygon does not hold the {what} ({}, {})", at[0], at[1])]
    NotInside {
        /// A fixed point, or lines.
        what: &'static str,
        /// Where, in input units.
        at: [f64; 2],
    },
    /// Triangles that make no surface, or leave in doubt which.
    #[error("{0}")]
    InvalidMesh(String),
    /// Points from which no triangulation can be made: fewer than three, or all on one line.
    #[error("{0}")]
    Degenerate(String),
}
