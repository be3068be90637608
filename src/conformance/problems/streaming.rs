//! Stage 4: one streaming step of a small domain with each kind of face.

use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;

use super::super::problem::Problem;
use super::super::random::Random;
use super::super::task::{Streaming, Task};
use super::MakeError;

pub(super) fn problems() -> Result<Vec<Problem>, MakeError> {
    let inlet = |x, y, z| Face::VelocityInlet { velocity: Vec3::new(x, y, z) };
    let wall = |x, y, z| Face::Wall { velocity: Vec3::new(x, y, z) };
    let boxes = [
        ("periodic", "periodic faces", "Eq. 1, left side", &["periodic"] as &[_], Faces::PERIODIC),
        (
            "walls",
            "walls at rest across y",
            "half-way bounce-back: f_a = f*_-a of the same cell",
            &["wall"],
            Faces { y: [Face::wall(); 2], ..Faces::PERIODIC },
        ),
        (
            "moving_wall",
            "a moving and a resting wall across z",
            "f_a = f*_-a + 6 w_a rho c_a.u_w, rho of the cell",
            &["wall", "moving_wall"],
            Faces { z: [Face::wall(), wall(0.05, -0.02, 0.0)], ..Faces::PERIODIC },
        ),
        (
            "free_slip",
            "free slip across x",
            "specular reflection at the face",
            &["free_slip"],
            Faces { x: [Face::FreeSlip; 2], ..Faces::PERIODIC },
        ),
        (
            "inlet_pressure",
            "velocity inlet at -y, pressure at +y",
            "inlet: as a wall of that velocity; pressure: f_a = -f*_-a + 2 w_a rho_w (1 + 9/2 (c_a.u)^2 - 3/2 u^2)",
            &["inlet", "pressure"],
            Faces {
                y: [inlet(0.01, 0.04, -0.02), Face::Pressure { density: 1.02 }],
                ..Faces::PERIODIC
            },
        ),
        (
            "inlet_outflow",
            "velocity inlet at +x, free outflow at -x",
            "zero gradient: f_a = f*_a of the outermost cell",
            &["inlet", "outflow"],
            Faces { x: [Face::FreeOutflow, inlet(-0.03, 0.01, 0.0)], ..Faces::PERIODIC },
        ),
        (
            "edges_and_corners",
            "free slip, walls (one moving), inlet and pressure meet",
            "a link that crosses a wall or an inlet is bounced back whatever else it crosses, with the \
             sum of their velocities; else a pressure face rules; else each crossed face wraps, mirrors \
             or clamps",
            &["corners", "free_slip", "wall", "moving_wall", "inlet", "pressure"],
            Faces {
                x: [Face::FreeSlip, Face::wall()],
                y: [inlet(0.0, 0.03, 0.0), Face::Pressure { density: 0.98 }],
                z: [wall(0.0, 0.04, 0.0), Face::FreeSlip],
            },
        ),
    ];
    let mut problems = Vec::new();
    for (seed, (id, title, equation, flags, faces)) in boxes.into_iter().enumerate() {
        let mut random = Random(400 + seed as u64);
        let domain = Domain::new([4, 3, 5], faces)?;
        let post = (0..domain.cell_count()).map(|_| random.populations()).collect();
        problems.push(Problem {
            id,
            stage: 4,
            title,
            notes: "Faces lie half a cell outside the outermost cells. The given populations are those \
                    after a collision; asked are those before the next.",
            equation,
            flags,
            task: Task::Streaming(Streaming { domain, post }),
        });
    }
    Ok(problems)
}
