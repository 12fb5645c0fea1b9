//! [`Draw`]: what a figure can show.

/// What a figure shows: layers of a map, which lie on each other in this order, charts, and a page of all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Draw {
    /// Voronoi cells coloured by their number of neighbours: white for 6, blues below, oranges above; 5 bears a minus, 7 a plus.
    Valence,
    /// Voronoi cells coloured by their area: dark for half the mean, light for one and a half.
    Capacity,
    /// The edges of the Voronoi diagram.
    Voronoi,
    /// The edges of the Delaunay triangulation.
    Delaunay,
    /// The points.
    Points,
    /// The power of each frequency, in log grey.
    PowerSpectrum,
    /// The radial mean of the power spectrum.
    RadialPower,
    /// How much the power differs by direction.
    Anisotropy,
    /// How many points there are at a distance from a point.
    PairCorrelation,
    /// The angles of the Delaunay triangles.
    Angles,
    /// A page of all these, with the measures; of many points the maps show a corner.
    Report,
}

impl Draw {
    /// All, each with its name and what it shows.
    pub const ALL: [(Self, &'static str, &'static str); 11] = [
        (Self::Points, "points", "The points"),
        (Self::Delaunay, "delaunay", "The Delaunay triangulation"),
        (Self::Voronoi, "voronoi", "The Voronoi diagram"),
        (Self::Valence, "valence", "Voronoi cells coloured by their number of neighbours"),
        (Self::Capacity, "capacity", "Voronoi cells coloured by their area"),
        (Self::PowerSpectrum, "spectrum", "The power spectrum, in log grey"),
        (Self::RadialPower, "radial", "The radial mean of the power spectrum"),
        (Self::Anisotropy, "anisotropy", "How much the power differs by direction"),
        (Self::PairCorrelation, "correlation", "The pair correlation"),
        (Self::Angles, "angles", "The angles of the triangles"),
        (Self::Report, "report", "One page of all of it"),
    ];

    /// What has this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, own, _)| *own == name).map(|&(draw, ..)| draw)
    }

    /// Whether it is part of a map.
    pub(super) fn is_layer(self) -> bool {
        self <= Self::Points
    }

    /// Whether it shows the power spectrum or the pair correlation.
    pub(super) fn is_spectral(self) -> bool {
        matches!(self, Self::PowerSpectrum | Self::RadialPower | Self::Anisotropy | Self::PairCorrelation | Self::Report)
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Valence => "Neighbours",
            Self::Capacity => "Voronoi areas",
            Self::Voronoi => "Voronoi diagram",
            Self::Delaunay => "Delaunay triangulation",
            Self::Points => "Points",
            Self::PowerSpectrum => "Power spectrum",
            Self::RadialPower => "Radial mean",
            Self::Anisotropy => "Anisotropy",
            Self::PairCorrelation => "Pair correlation",
            Self::Angles => "Angles of triangles",
            Self::Report => "Report",
        }
    }

    pub(super) fn caption(self) -> &'static str {
        match self {
            Self::Valence => "6 white, 5 blue with a minus, 7 orange with a plus",
            Self::Capacity => "from half the mean (dark) to one and a half (light)",
            Self::PowerSpectrum => "frequency 0 in the middle; log grey from 0.01 to 10, white noise is 1",
            Self::RadialPower => "black: from all distances; blue: over rings of the spectrum",
            Self::Anisotropy => "dashed: what depends on no direction",
            Self::PairCorrelation => "dashed: white noise",
            Self::Angles => "dotted: 90\u{b0}",
            _ => "",
        }
    }
}
