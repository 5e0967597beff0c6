//! Colours, dashes and sizes.

use crate::sheet::{Colour, Stroke};

/// Text and frames.
pub(crate) const INK: Colour = [0x22, 0x22, 0x22];
pub(crate) const PALE_INK: Colour = [0x5a, 0x5f, 0x66];
pub(crate) const GRID: Colour = [0xe3, 0xe6, 0xea];
pub(crate) const FRAME: Colour = [0x8a, 0x90, 0x98];
pub(crate) const EVENT: Colour = [0x8a, 0x90, 0x98];

/// Sizes of text \[px\].
pub(crate) const TITLE: f64 = 16.0;
pub(crate) const LABEL: f64 = 12.5;
pub(crate) const SMALL: f64 = 11.0;
pub(crate) const TINY: f64 = 9.5;

/// Width of a curve \[px\].
const CURVE: f64 = 1.6;

/// Most curves that have a colour of their own.
pub(crate) const MOST_COLOURS: usize = 8;

/// Colours that people who see few colours tell apart, of Okabe and Ito, without the yellow that white paper
/// swallows.
const COLOURS: [Colour; MOST_COLOURS] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0x00, 0x00, 0x00],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0x7a, 0x52, 0x30],
];

/// Dashes differ as well, for those who print in black.
const DASHES: [&[f64]; 4] = [&[], &[7.0, 3.5], &[2.0, 3.0], &[9.0, 4.0, 2.0, 4.0]];

/// From dark to light, for more curves than there are colours (viridis without its yellow end).
const RAMP: [[f64; 3]; 5] = [
    [68.0, 1.0, 84.0],
    [59.0, 82.0, 139.0],
    [33.0, 145.0, 140.0],
    [94.0, 201.0, 98.0],
    [160.0, 218.0, 57.0],
];

/// How the curve `number` of `count` is drawn.
pub(crate) fn stroke(number: usize, count: usize) -> Stroke {
    if count <= MOST_COLOURS {
        let dash = DASHES[number % DASHES.len()];
        return Stroke { colour: COLOURS[number % MOST_COLOURS], width: CURVE, dash };
    }
    let place = number as f64 / (count - 1) as f64 * (RAMP.len() - 1) as f64;
    let from = (place as usize).min(RAMP.len() - 2);
    let share = place - from as f64;
    let part = |i: usize| RAMP[from][i] + (RAMP[from + 1][i] - RAMP[from][i]) * share;
    let colour = [0, 1, 2].map(|i| part(i).round() as u8);
    Stroke { colour, width: 1.0, dash: &[] }
}
