//! Colours, dashes and markers that stay apart for colour-blind readers and in grey print.

use plotters::style::RGBColor;

use crate::series::Marker;

/// Okabe and Ito's colours (2008), without the yellow, which is too pale for lines on white.
pub(crate) const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2), // blue
    RGBColor(0xD5, 0x5E, 0x00), // vermillion
    RGBColor(0x00, 0x9E, 0x73), // bluish green
    RGBColor(0xCC, 0x79, 0xA7), // reddish purple
    RGBColor(0xE6, 0x9F, 0x00), // orange
    RGBColor(0x56, 0xB4, 0xE9), // sky blue
    RGBColor(0x00, 0x00, 0x00), // black
];

/// Markers, in the order in which series take them.
pub(crate) const MARKERS: [Marker; 7] = [
    Marker::Circle,
    Marker::Square,
    Marker::TriangleUp,
    Marker::Diamond,
    Marker::TriangleDown,
    Marker::Ring,
    Marker::Cross,
];

/// Length of dash and gap in pixels, in the order in which lines take them.
pub(crate) const DASHES: [Dash; 5] =
    [None, Some((8.0, 4.0)), Some((2.5, 2.5)), Some((16.0, 4.0)), Some((5.0, 8.0))];

/// The same for reference lines.
pub(crate) const REFERENCE_DASHES: [Dash; 3] =
    [Some((5.0, 3.0)), Some((1.5, 3.0)), Some((11.0, 3.0))];

/// Dash and gap in pixels; solid where `None`.
pub(crate) type Dash = Option<(f64, f64)>;

pub(crate) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(crate) const FAINT_INK: RGBColor = RGBColor(0x55, 0x55, 0x55);
pub(crate) const GRID: RGBColor = RGBColor(0xDD, 0xDD, 0xDD);
pub(crate) const FAINT_GRID: RGBColor = RGBColor(0xEF, 0xEF, 0xEF);
pub(crate) const ZERO: RGBColor = RGBColor(0xA0, 0xA0, 0xA0);
pub(crate) const PAPER: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);

/// Viridis (van der Walt and Smith, 2015) at ten steps: even in lightness, also for the colour-blind.
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3E, 0x49, 0x89],
    [0x31, 0x68, 0x8E],
    [0x26, 0x82, 0x8E],
    [0x1F, 0x9E, 0x89],
    [0x35, 0xB7, 0x79],
    [0x6E, 0xCE, 0x58],
    [0xB5, 0xDE, 0x2B],
    [0xFD, 0xE7, 0x25],
];

/// The colour of a value on a map, from 0 (dark) to 1 (light).
pub(crate) fn map_colour(fraction: f64) -> RGBColor {
    let last = VIRIDIS.len() - 1;
    let along = fraction.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
    let step = (along as usize).min(last - 1);
    let part = along - step as f64;
    let mix = |i: usize| {
        let (a, b) = (f64::from(VIRIDIS[step][i]), f64::from(VIRIDIS[step + 1][i]));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let mixed = (a + part * (b - a)).round() as u8;
        mixed
    };
    RGBColor(mix(0), mix(1), mix(2))
}
