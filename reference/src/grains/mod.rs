//! Grains: contact, neighbours, motion (being written).
