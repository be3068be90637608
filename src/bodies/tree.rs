//! A tree of boxes about triangles: which of them may touch.

use psmrt_reference::lattice::Vec3;

/// Triangles in a box are no longer divided.
const FEW: usize = 4;

/// Boxes within boxes.
pub(super) struct Tree {
    /// The numbers of the triangles, those of each box one behind the other.
    order: Vec<usize>,
    boxes: Vec<Node>,
}

struct Node {
    low: Vec3,
    high: Vec3,
    /// Where its triangles stand in the order.
    from: usize,
    to: usize,
    /// The two boxes within.
    within: Option<[usize; 2]>,
}

impl Tree {
    pub(super) fn of(corners: &[[Vec3; 3]]) -> Self {
        let mut tree = Tree { order: (0..corners.len()).collect(), boxes: Vec::new() };
        tree.divide(corners, 0, corners.len());
        tree
    }

    /// Makes the box about some of the order, and those within; its number.
    fn divide(&mut self, corners: &[[Vec3; 3]], from: usize, to: usize) -> usize {
        let all = self.order[from..to].iter().flat_map(|&n| corners[n]);
        let none = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
        let [low, high] = all.fold(none, |[low, high], v| [low.inf(&v), high.sup(&v)]);
        let number = self.boxes.len();
        self.boxes.push(Node { low, high, from, to, within: None });
        if to - from > FEW {
            let axis = (high - low).imax();
            let middle = (to - from) / 2;
            let place = |n: &usize| corners[*n].iter().map(|corner| corner[axis]).sum::<f64>();
            self.order[from..to]
                .select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
            let lower = self.divide(corners, from, from + middle);
            let upper = self.divide(corners, from + middle, to);
            self.boxes[number].within = Some([lower, upper]);
        }
        number
    }

    /// The first pair, of those whose boxes touch, that is one by `is_pair`.
    pub(super) fn first_pair(&self, is_pair: impl Fn(usize, usize) -> bool) -> Option<[usize; 2]> {
        let mut waiting = vec![[0, 0]];
        while let Some([one, other]) = waiting.pop() {
            let [first, second] = [one, other].map(|n| &self.boxes[n]);
            let touch = first.low.inf(&second.high) == first.low
                && second.low.inf(&first.high) == second.low;
            if !touch {
                continue;
            }
            match (first.within, second.within) {
                (Some([a, b]), _) if one == other => waiting.extend([[a, a], [b, b], [a, b]]),
                (Some([a, b]), None) => waiting.extend([[a, other], [b, other]]),
                (None, Some([a, b])) => waiting.extend([[one, a], [one, b]]),
                // The larger one.
                (Some([a, b]), Some([c, d])) => {
                    if first.to - first.from >= second.to - second.from {
                        waiting.extend([[a, other], [b, other]]);
                    } else {
                        waiting.extend([[one, c], [one, d]]);
                    }
                }
                (None, None) => {
                    for i in first.from..first.to {
                        let start = if one == other { i + 1 } else { second.from };
                        for j in start..second.to {
                            let (a, b) = (self.order[i], self.order[j]);
                            if is_pair(a, b) {
                                return Some([a, b]);
                            }
                        }
                    }
                }
            }
        }
        None
    }
}
