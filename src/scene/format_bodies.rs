//! The keys of a body that is no sphere.

use schemars::JsonSchema;
use serde::Deserialize;

use super::triple::Triple;

/// A body that is no sphere: from an STL file, or one of a few simple shapes. The solid fraction of each cell is exact, the volume
/// that the cell and the body's flat sides have in common. A body is fixed or moves as prescribed, and may be turned about its
/// `centre`. What of it lies beyond a face that is not periodic is cut off.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodySection {
    /// `stl` (a closed surface in a file), `box`, `cylinder`, `pipe` (the wall of a round pipe) or `half_space` (all
    /// on one side of a plane). Cylinders and pipes have 256 flat sides and the area of the circle.
    pub shape: BodyShapeName,
    /// With `stl`: the file, text or binary, relative to the scene. Its triangles must enclose a volume without holes, face
    /// outward and not cross each other.
    pub file: Option<String>,
    /// With `stl`: how long a unit of the file is, m (1e-3 for a drawing in millimetres): STL files do not say it.
    pub scale: Option<f64>,
    /// With `stl`: the point of the file, in its units, that lies at `centre`; the centre of the body's volume where absent.
    pub origin: Option<Triple>,
    /// With `box`: its edges along x, y and z, before it is turned, m.
    pub size: Option<Triple>,
    /// With `cylinder`: its diameter; with `pipe`: the inner one, m.
    pub diameter: Option<f64>,
    /// With `pipe`: thickness of its wall, m; where absent all is solid outside.
    pub wall: Option<f64>,
    /// With `cylinder` and `pipe`: the length along its axis, m; without end where absent.
    pub length: Option<f64>,
    /// With `cylinder` and `pipe`: the direction of the axis, for example `[0, 0, 1]`.
    pub axis: Option<Triple>,
    /// With `half_space`: the direction that leads out of the solid into the fluid; `centre` is a point of the plane.
    pub normal: Option<Triple>,
    /// With `stl` and `box`: how it is turned about its `centre`.
    pub turn: Option<TurnSection>,
}

/// A turn about an axis through the centre, counter-clockwise if one looks against the axis.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TurnSection {
    /// The direction of the axis.
    pub axis: Triple,
    /// By how much, degrees.
    pub degrees: f64,
}

/// A shape.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum BodyShapeName {
    /// A closed surface in a file.
    Stl,
    /// A box.
    Box,
    /// A round cylinder.
    Cylinder,
    /// The wall of a round pipe.
    Pipe,
    /// One side of a plane.
    HalfSpace,
}

impl BodyShapeName {
    /// As scenes spell it.
    pub fn word(self) -> &'static str {
        match self {
            BodyShapeName::Stl => "stl",
            BodyShapeName::Box => "box",
            BodyShapeName::Cylinder => "cylinder",
            BodyShapeName::Pipe => "pipe",
            BodyShapeName::HalfSpace => "half_space",
        }
    }
}
