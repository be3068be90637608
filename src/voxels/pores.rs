//! Whether the pores let fluid through: a path from cell to cell, along the lattice's directions, none of them solid
//! throughout, from one end of an axis to the other; where the axis is periodic one that comes back to where it began, a
//! period further on.

use psmrt_reference::directions::C;
use psmrt_reference::domain::Domain;
use psmrt_reference::setup::Setup;

/// A cell that is no pore.
const SOLID: i32 = i32::MIN;

/// A pore that no path has reached yet.
const UNSEEN: i32 = i32::MAX;

/// Pores of a domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pores {
    /// Cells that are not solid throughout.
    pub all: usize,
    /// Those of them that lie on a path through the domain, or hang on one.
    pub through: usize,
}

/// Which cells of a set-up one of its solids fills.
pub fn solid_cells(setup: &Setup) -> Vec<bool> {
    let mut is_solid = vec![false; setup.domain.cell_count()];
    let Some(phase) = &setup.solid_phase else { return is_solid };
    for solid in &phase.solids {
        for at in solid.covered(&setup.domain, phase.coverage) {
            is_solid[at.cell] |= at.epsilon == 1.0;
        }
    }
    is_solid
}

/// The pores of a domain of which the cells that `is_solid` names are solid throughout, and those through which fluid gets
/// along `axis`.
pub fn pores(domain: &Domain, is_solid: &[bool], axis: usize) -> Pores {
    // How many periods away from its own domain the path was that reached a cell first.
    let mut turns: Vec<i32> =
        is_solid.iter().map(|solid| if *solid { SOLID } else { UNSEEN }).collect();
    let all = turns.iter().filter(|turn| **turn == UNSEEN).count();
    let mut through = 0;
    for start in 0..turns.len() {
        if turns[start] == UNSEEN {
            let cluster = cluster(domain, &mut turns, axis, start);
            through += if cluster.is_through { cluster.cells } else { 0 };
        }
    }
    Pores { all, through }
}

/// Pores that hang together.
struct Cluster {
    cells: usize,
    is_through: bool,
}

fn cluster(domain: &Domain, turns: &mut [i32], axis: usize, start: usize) -> Cluster {
    let length = domain.cells()[axis];
    let (mut at_low, mut at_high, mut comes_back) = (false, false, false);
    turns[start] = 0;
    let mut todo = vec![start];
    let mut cells = 0;
    while let Some(cell) = todo.pop() {
        cells += 1;
        let here = domain.coordinates(cell);
        at_low |= here[axis] == 0;
        at_high |= here[axis] + 1 == length;
        for direction in &C[1..] {
            let to = [0, 1, 2].map(|along| signed(here[along]) + i64::from(direction[along]));
            let Some(inside) = domain.locate(to) else { continue };
            let next = domain.index(inside);
            // Beyond an end of a periodic axis it is a period on.
            let turn =
                turns[cell] + i32::from(to[axis] >= signed(length)) - i32::from(to[axis] < 0);
            match turns[next] {
                SOLID => {}
                UNSEEN => {
                    turns[next] = turn;
                    todo.push(next);
                }
                known => comes_back |= known != turn,
            }
        }
    }
    let is_through = if domain.is_periodic(axis) { comes_back } else { at_low && at_high };
    Cluster { cells, is_through }
}

#[expect(clippy::cast_possible_wrap, reason = "cells along an axis")]
fn signed(coordinate: usize) -> i64 {
    coordinate as i64
}
