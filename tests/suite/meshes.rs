//! Bodies as closed surfaces: which triangles are one, and the share of each cell that they fill, against formulas and counting.

use std::f64::consts::PI;

use nalgebra::UnitQuaternion;
use psmrt::bodies::closed::MeshError;
use psmrt::bodies::formula::{cuboid, cylinder, half_space, pipe};
use psmrt::bodies::mesh::Mesh;
use psmrt::bodies::pose::Pose;
use psmrt::bodies::shares::solid_shares;
use psmrt::bodies::stl;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;

use crate::surfaces::{ascii, ball, binary};

const CELLS: [usize; 3] = [12, 11, 10];

fn placed(mesh: &Mesh, centre: [f64; 3], turn: UnitQuaternion<f64>) -> Mesh {
    Pose { centre: Vec3::from(centre), turn }.place(mesh)
}

/// A turn about no axis in particular.
fn askew(random: &mut SplitMix64) -> UnitQuaternion<f64> {
    let mut angle = || 2.0 * PI * random.unit();
    UnitQuaternion::from_euler_angles(angle(), angle(), angle())
}

/// The shares of a body that is one.
fn shares_of(body: &Mesh) -> Vec<(usize, f64)> {
    solid_shares(body, CELLS).unwrap()
}

fn total(shares: &[(usize, f64)]) -> f64 {
    shares.iter().map(|(_, share)| share).sum()
}

#[test]
fn a_box_along_the_axes_fills_of_each_cell_the_product_of_three_lengths() {
    let mut random = SplitMix64::new(3);
    for _ in 0..20 {
        let edges = Vec3::from([0; 3].map(|_| 0.1 + 5.0 * random.unit()));
        // Some of them reach out of the domain.
        let centre = [0, 1, 2].map(|axis| CELLS[axis] as f64 * random.unit());
        let shares = shares_of(&placed(&cuboid(&edges), centre, UnitQuaternion::identity()));
        let mut found = vec![0.0; CELLS.iter().product()];
        for (cell, share) in shares {
            found[cell] = share;
        }
        for (cell, found) in found.into_iter().enumerate() {
            let at = [cell % CELLS[0], cell / CELLS[0] % CELLS[1], cell / (CELLS[0] * CELLS[1])];
            let along = |axis: usize| {
                let [low, high] = [-0.5, 0.5].map(|half| centre[axis] + half * edges[axis]);
                let cell = at[axis] as f64;
                (high.min(cell + 1.0) - low.max(cell)).max(0.0)
            };
            let expected = along(0) * along(1) * along(2);
            assert!(
                (found - expected).abs() < 1e-9,
                "cell {at:?} of a box of {edges:?} about {centre:?}: {found}, by lengths {expected}"
            );
        }
    }
}

#[test]
fn bodies_however_turned_fill_their_volume() {
    let mut random = SplitMix64::new(4);
    let bodies = [
        ("box", cuboid(&Vec3::new(3.0, 2.0, 4.0)), 24.0),
        ("cylinder", cylinder(2.0, 3.0), PI * 4.0 * 3.0),
        ("pipe", pipe(1.5, 2.5, 2.0), PI * (6.25 - 2.25) * 2.0),
    ];
    for (name, mesh, volume) in bodies {
        // Twelve digits of sums over some thousand pieces of up to 1 each.
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-12, "{name}: {}", mesh.volume());
        assert!(mesh.middle().norm() < 1e-12, "{name}: about {:?}", mesh.middle());
        assert!(Mesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).is_ok(), "{name}");
        for _ in 0..10 {
            let shares = shares_of(&placed(&mesh, [6.1, 5.3, 4.9], askew(&mut random)));
            let found = total(&shares);
            assert!((found / volume - 1.0).abs() < 1e-8, "{name}: {found} of {volume} cells");
        }
    }
}

#[test]
fn a_turned_box_fills_of_each_cell_what_points_in_it_say() {
    let mut random = SplitMix64::new(5);
    let half = Vec3::new(2.1, 1.3, 2.7);
    let turn = askew(&mut random);
    let centre = [6.3, 5.2, 4.6];
    let shares = shares_of(&placed(&cuboid(&(2.0 * half)), centre, turn));
    let back = turn.inverse();
    let mut worst = 0.0_f64;
    for &(cell, share) in &shares {
        let at = [cell % CELLS[0], cell / CELLS[0] % CELLS[1], cell / (CELLS[0] * CELLS[1])];
        let points = 40;
        let place = |n: i32| (f64::from(n) + 0.5) / f64::from(points);
        let mut inside = 0;
        for n in 0..points * points * points {
            let at = Vec3::from(at.map(|x| x as f64))
                + Vec3::new(
                    place(n % points),
                    place(n / points % points),
                    place(n / (points * points)),
                );
            let own = back * (at - Vec3::from(centre));
            inside += i32::from((0..3).all(|axis| own[axis].abs() < half[axis]));
        }
        worst = worst.max((share - f64::from(inside) / f64::from(points.pow(3))).abs());
    }
    // A plane through 40 x 40 rows of points is met to half of their distance in each.
    assert!(
        worst < 1.0 / 80.0,
        "a cell of a turned box differs by {worst} from what 64,000 points in it say"
    );
    assert!(shares.len() > 80, "{} cells", shares.len());
}

#[test]
fn what_lies_beyond_the_domain_is_cut_off() {
    // The lower half of the domain, and a cylinder from its floor to its lid.
    let below = placed(&half_space(100.0), [6.0, 5.0, 5.0], UnitQuaternion::identity());
    assert!((total(&shares_of(&below)) - 12.0 * 11.0 * 5.0).abs() < 1e-9);
    let column = placed(&cylinder(3.0, 100.0), [6.0, 5.5, 5.0], UnitQuaternion::identity());
    let shares = shares_of(&column);
    assert!((total(&shares) / (PI * 9.0 * 10.0) - 1.0).abs() < 1e-9, "{}", total(&shares));
    // Just as high as the domain.
    let exact = placed(&cylinder(3.0, 10.0), [6.0, 5.5, 5.0], UnitQuaternion::identity());
    let as_high = shares_of(&exact);
    assert_eq!(
        as_high.len(),
        shares.len(),
        "cells of a cylinder as high as the domain, and of one that is cut off there"
    );
    for (one, other) in as_high.iter().zip(&shares) {
        assert!(one.0 == other.0 && (one.1 - other.1).abs() < 1e-9, "{one:?} and {other:?}");
    }
    let outside = placed(&cylinder(3.0, 1.0), [30.0, 5.5, 5.0], UnitQuaternion::identity());
    assert!(shares_of(&outside).is_empty());
}

#[test]
fn a_sphere_of_ever_more_triangles_fills_what_the_sphere_does_at_second_order_in_their_edge() {
    let domain = Domain::new([24; 3], Faces::PERIODIC).unwrap();
    let (centre, radius) = ([12.3, 11.8, 12.1], 8.4);
    let mut expected = vec![0.0; domain.cell_count()];
    for at in Solid::fixed_sphere(Vec3::from(centre), radius).covered(&domain, CoverageRule::Exact)
    {
        expected[at.cell] = at.epsilon;
    }
    let worst = |level: u32| {
        let mesh = placed(&ball(radius, level), centre, UnitQuaternion::identity());
        let mut found = vec![0.0; domain.cell_count()];
        for (cell, share) in solid_shares(&mesh, [24; 3]).unwrap() {
            found[cell] = share;
        }
        found.iter().zip(&expected).map(|(a, b)| f64::abs(a - b)).fold(0.0, f64::max)
    };
    let errors = [2, 3, 4, 5].map(worst);
    for pair in errors.windows(2) {
        // A quarter for half the edge.
        assert!((3.0..5.5).contains(&(pair[0] / pair[1])), "largest errors of a share: {errors:?}");
    }
    // A flat triangle of edge s lies up to s²/(6 R) inside of the sphere: R/3 of its 20 480 triangles, s = 0.037 R.
    assert!(errors[3] < 8.4 * 0.037_f64.powi(2) / 6.0 * 1.8, "{errors:?}");
}

#[test]
fn text_and_binary_stl_files_are_the_same_body_whatever_they_begin_with() {
    let mesh = ball(1.0, 1);
    let text = stl::mesh(ascii(&mesh).into_bytes()).unwrap();
    let mut bytes = binary(&mesh);
    let plain = stl::mesh(bytes.clone()).unwrap();
    assert_eq!(text, plain, "as text and binary");
    bytes[..6].copy_from_slice(b"solid ");
    assert_eq!(stl::mesh(bytes).unwrap(), plain, "a binary file that begins like a text");
    assert_eq!(text.triangles().len(), mesh.triangles().len());
    assert_eq!(text.vertices().len(), mesh.vertices().len(), "corners in the same place are one");
    // Single precision: seven digits.
    assert!((text.volume() / mesh.volume() - 1.0).abs() < 1e-6);
}

#[test]
fn surfaces_that_enclose_nothing_are_told_with_the_triangle() {
    let good = ball(1.0, 1);
    let (vertices, triangles) = (good.vertices().to_vec(), good.triangles().to_vec());
    let change = |change: &dyn Fn(&mut Vec<[u32; 3]>)| {
        let mut triangles = triangles.clone();
        change(&mut triangles);
        Mesh::new(vertices.clone(), triangles).unwrap_err()
    };
    let open = change(&|all| {
        all.remove(7);
    });
    let MeshError::Open { triangle, from, to } = open else { panic!("{open}") };
    let corners = triangles[7].map(|n| <[f64; 3]>::from(vertices[n as usize]));
    assert!(corners.contains(&from) && corners.contains(&to), "the hole is triangle 7's: {open}");
    assert_ne!(triangle, 7);
    let turned = change(&|all| all[7].swap(1, 2));
    let MeshError::TurnedOver { first, second } = turned else { panic!("{turned}") };
    assert!(first == 7 || second == 7, "{turned}");
    let inside_out = change(&|all| all.iter_mut().for_each(|one| one.swap(1, 2)));
    assert!(matches!(inside_out, MeshError::InsideOut { volume } if volume < 0.0), "{inside_out}");
    assert_eq!(change(&Vec::clear), MeshError::Empty);
    // Two balls that overlap.
    let count = u32::try_from(vertices.len()).unwrap();
    let mut both = vertices.clone();
    both.extend(vertices.iter().map(|v| v + Vec3::new(0.9, 0.1, 0.2)));
    let mut two = triangles.clone();
    two.extend(triangles.iter().map(|one| one.map(|n| n + count)));
    let crossing = Mesh::new(both, two.clone()).unwrap_err();
    assert!(matches!(crossing, MeshError::Crossing { .. }), "{crossing}");
    // Apart, they are one body in two parts.
    let mut apart = vertices.clone();
    apart.extend(vertices.iter().map(|v| v + Vec3::new(2.5, 0.0, 0.0)));
    let two = Mesh::new(apart, two).unwrap();
    assert!((two.volume() / good.volume() - 2.0).abs() < 1e-12);
    let twice = change(&|all| all.extend(all.clone()));
    assert!(matches!(twice, MeshError::Twice { .. }), "{twice}");
    for (bytes, told) in [
        (Vec::new(), "no STL file"),
        (b"nothing of the kind".to_vec(), "no STL file"),
        (b"solid x\nfacet normal 0 0 0\n".to_vec(), "no STL file"),
        (b"solid x\nendsolid x\n".to_vec(), "no triangles"),
        (binary(&good)[..200].to_vec(), "no STL file"),
    ] {
        let said = stl::mesh(bytes).unwrap_err().to_string();
        assert!(said.contains(told), "{said}");
    }
}

/// Two boxes of 4 cells, the second one `along` x from the first, turned inside out or not; their triangles in turn.
fn two_boxes(along: f64, is_inside_out: bool) -> Result<Mesh, MeshError> {
    let one = placed(&cuboid(&Vec3::repeat(4.0)), [3.0, 5.0, 5.0], UnitQuaternion::identity());
    let count = u32::try_from(one.vertices().len()).unwrap();
    let mut vertices = one.vertices().to_vec();
    vertices.extend(one.vertices().iter().map(|v| v + Vec3::new(along, 0.0, 0.0)));
    let mut triangles = Vec::new();
    for &triangle in one.triangles() {
        let [a, b, c] = triangle.map(|n| n + count);
        triangles.push(triangle);
        triangles.push(if is_inside_out { [a, c, b] } else { [a, b, c] });
    }
    Mesh::new(vertices, triangles)
}

#[test]
fn parts_that_overlap_or_face_inward_are_told_by_the_cells_that_they_fill() {
    // Sides in the same planes do not cross, and the volume of the two is that of the two.
    let wrong = solid_shares(&two_boxes(2.0, false).unwrap(), CELLS).unwrap_err();
    assert!((wrong.share - 2.0).abs() < 1e-9, "{wrong}");
    assert!(wrong.to_string().contains("overlap"), "{wrong}");
    assert!(matches!(two_boxes(5.0, true), Err(MeshError::InsideOut { .. })));
    // Beside each other, and with a side in common, they are what they are.
    for along in [4.0, 5.0] {
        let shares = shares_of(&two_boxes(along, false).unwrap());
        assert!((total(&shares) - 128.0).abs() < 1e-9, "{along}: {}", total(&shares));
    }
    // A cavity is a part that faces inward within another.
    let outer = cuboid(&Vec3::repeat(6.0));
    let inner = cuboid(&Vec3::repeat(3.0));
    let mut vertices = outer.vertices().to_vec();
    vertices.extend(inner.vertices());
    let turned = inner.triangles().iter().map(|&[a, b, c]| [a + 8, c + 8, b + 8]);
    let triangles: Vec<_> = outer.triangles().iter().copied().chain(turned).collect();
    let hollow = Mesh::new(vertices.clone(), triangles.clone()).unwrap();
    let shares = shares_of(&placed(&hollow, [5.5, 5.5, 5.0], UnitQuaternion::identity()));
    assert!((total(&shares) - (216.0 - 27.0)).abs() < 1e-9, "{}", total(&shares));
    // One that sticks out is none.
    for corner in &mut vertices[8..] {
        corner.x += 9.0;
    }
    let apart = Mesh::new(vertices, triangles).unwrap();
    let wrong =
        solid_shares(&placed(&apart, [3.5, 5.5, 5.0], UnitQuaternion::identity()), [20, 11, 10])
            .unwrap_err();
    // Its edges lie in the middle of cells: an eighth of one at the least.
    assert!(wrong.share < -0.12, "{wrong}");
}
