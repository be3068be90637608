//! Images of solids: what of a cell is solid, against counting; flow through them, against the spheres that they show; which
//! pores let fluid through.

use std::fs;
use std::path::Path;

use psmrt::advice::estimate::warnings;
use psmrt::engine::{Block, EngineName, open};
use psmrt::output::npy;
use psmrt::scene::Scene;
use psmrt::voxels::body::VoxelBody;
use psmrt::voxels::image::{AxisOrder, Image};
use psmrt::voxels::phase::Phase;
use psmrt::voxels::pores::{Pores, pores};
use psmrt::voxels::shares::{Placed, solid_shares};
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use crate::cli::Folder;
use crate::common::Budget;

/// Voxels along x, y, z as a NumPy array of axes z, y, x.
fn array(counts: [usize; 3], number: impl Fn([usize; 3]) -> f64) -> Vec<u8> {
    let [nx, ny, nz] = counts;
    let numbers = (0..nx * ny * nz).map(|i| number([i % nx, i / nx % ny, i / (nx * ny)]));
    let mut bytes = Vec::new();
    npy::array(&mut bytes, &[nz, ny, nx], numbers).unwrap();
    bytes
}

/// All of an image, its ones being solid.
fn body(counts: [usize; 3], number: impl Fn([usize; 3]) -> f64) -> VoxelBody {
    VoxelBody {
        image: Image::of_npy(array(counts, number), AxisOrder::Zyx).unwrap(),
        first: [0; 3],
        used: counts,
        is_mirrored: [false; 3],
        phase: Phase::Values(vec![1.0]),
    }
}

/// 0 or 1, without order.
fn noise([x, y, z]: [usize; 3]) -> f64 {
    let mixed = (x * 7919 + y * 104_729 + z * 1_299_709 + 12_345).wrapping_mul(2_654_435_761);
    ((mixed >> 16) & 1) as f64
}

#[test]
fn the_solid_share_of_a_cell_is_what_it_has_in_common_with_solid_voxels() {
    // Voxels of 3/4 cell from (1/4, 1/2, 0): both are made of cubes of a quarter of a cell, which can be counted.
    let (counts, cells, corner) = ([7, 6, 5], [6, 5, 4], [1, 2, 0]);
    let body = body(counts, noise);
    let placed = Placed { corner: corner.map(|n| f64::from(n) / 4.0), voxel: 0.75, cells };
    let found = solid_shares(&body, &placed);
    let mut seen = 0;
    for cell in 0..cells.iter().product() {
        let at = [cell % 6, cell / 6 % 5, cell / 30];
        let cubes = (0..64).map(|cube| [cube % 4, cube / 4 % 4, cube / 16]);
        let solid = cubes.filter(|cube| {
            let voxel: Vec<Option<usize>> = (0..3)
                .map(|axis| {
                    let from_corner = (4 * at[axis] + cube[axis])
                        .checked_sub(usize::try_from(corner[axis]).ok()?)?;
                    Some(from_corner / 3).filter(|&voxel| voxel < counts[axis])
                })
                .collect();
            matches!(voxel[..], [Some(x), Some(y), Some(z)] if noise([x, y, z]) == 1.0)
        });
        let expected = solid.count() as f64 / 64.0;
        let share = found.iter().find(|(known, _)| *known == cell).map_or(0.0, |(_, share)| *share);
        assert!((share - expected).abs() < 1e-12, "cell {at:?}: {share}, counted {expected}");
        seen += usize::from(share > 0.0);
    }
    assert_eq!(seen, found.len(), "cells are listed once, and none without solid");
    assert!(seen > 60, "the test looks at {seen} cells that are not empty");
}

/// A ball of `cells` cells across, off the middle of a cube of 12, as an image with `finer` voxels in a cell.
fn ball(cells: f64, finer: usize) -> (Solid, Solid, Domain) {
    let domain = Domain::new([12; 3], Faces::PERIODIC).unwrap();
    let centre = Vec3::new(6.13, 5.91, 6.37);
    let inside = |at: [usize; 3]| {
        let place = Vec3::from(at.map(|n| (n as f64 + 0.5) / finer as f64));
        f64::from(u8::from((place - centre).norm() < 0.5 * cells))
    };
    let body = body([12 * finer; 3], inside);
    let placed = Placed { corner: [0.0; 3], voxel: 1.0 / finer as f64, cells: [12; 3] };
    let image = Solid::fixed_cells(solid_shares(&body, &placed));
    (Solid::fixed_sphere(centre, 0.5 * cells), image, domain)
}

#[test]
fn solid_fractions_of_an_image_of_a_ball_converge_to_the_exact_ones() {
    let error = |finer: usize| {
        let (sphere, image, domain) = ball(8.0, finer);
        let mut filled = vec![0.0; domain.cell_count()];
        sphere
            .covered(&domain, CoverageRule::Exact)
            .iter()
            .for_each(|at| filled[at.cell] += at.epsilon);
        image
            .covered(&domain, CoverageRule::Exact)
            .iter()
            .for_each(|at| filled[at.cell] -= at.epsilon);
        let cut = filled.iter().map(|difference| difference * difference).sum::<f64>();
        (cut / filled.iter().filter(|difference| **difference != 0.0).count() as f64).sqrt()
    };
    let errors = [1, 2, 4, 8].map(error);
    for pair in errors.windows(2) {
        // Some n² voxels in a cell are cut, each wrong by up to half its n^-3 with a sign of its own: n^-2, and n^-1 if all
        // had the same one. Between two sizes chance has its part.
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 1.0, "errors {errors:?}: one falls at order {order:.2} only");
    }
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(
        (1.3..2.7).contains(&order),
        "errors {errors:?} fall at order {order:.2}, about 2 expected"
    );
}

/// Water that a force drives through one ball of 12.8 cells in a periodic cube of 16.
fn array_scene(folder: &Folder, grains: &str) -> Scene {
    let text = crate::scenes::water(
        [16; 3],
        6.25e-6,
        &format!(
            "[body_force]\nacceleration = [0.1, 0.0, 0.0]\n{grains}\n[[records]]\nname = \"k\"\n\
             kind = \"permeability\"\naxis = \"x\"\n[stop]\nsteps = 700\n"
        ),
    );
    let path = folder.write("scene.toml", text);
    Scene::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Its permeability, m2, after 700 steps, in which what is left to go has fallen to 1e-4.
fn permeability(scene: &Scene, budget: &mut Budget) -> f64 {
    budget.spend(700 * 4096);
    let mut engine = open(EngineName::Cpu, scene, None, false).unwrap();
    engine.step(700).unwrap();
    psmrt::output::records::seepage_now(scene, &engine, (0, 9.81)).si_permeability()
}

#[test]
fn an_array_of_spheres_as_an_image_is_as_permeable_as_its_spheres_to_one_percent() {
    let mut budget = Budget::kernel(9_000_000);
    let folder = Folder::new("sphere_image");
    let spheres = "[[grains]]\nkind = \"array\"\nlattice = \"sc\"\ndiameter = 8e-5\n";
    let exact = permeability(&array_scene(&folder, spheres), &mut budget);
    let inside = |at: [usize; 3]| {
        let squares = at.map(|n| ((n as f64 + 0.5) / 64.0 - 0.5).powi(2));
        f64::from(u8::from(squares.iter().sum::<f64>() < 0.16))
    };
    folder.write("ball.npy", array([64; 3], inside));
    let image = "[[grains]]\nkind = \"voxels\"\nimage = { file = \"ball.npy\", voxel = 1.5625e-6, solid = [1] }\n";
    let scene = array_scene(&folder, image);
    let found = permeability(&scene, &mut budget);
    // The image's solid is that of the spheres to 0.3 % (its voxels), and k goes with the solid fraction to the power -1.6
    // there (Zick & Homsy 1982): half a percent, and as much again for where the voxels are.
    let error = found / exact - 1.0;
    assert!(
        error.abs() < 0.01,
        "k of the image is {found:.4e} m2, of the spheres {exact:.4e}: {error:+.4}"
    );
    // Its mean diameter by lines that cross its surface: that of the spheres, 12.8 cells, to what 4 cells of surface tell.
    let engine = open(EngineName::Cpu, &scene, None, false).unwrap();
    let diameter = psmrt::output::records::seepage_now(&scene, &engine, (0, 9.81)).si_diameter;
    assert!(
        (diameter / 8e-5 - 1.0).abs() < 0.03,
        "6 V/S of the image is {diameter:.4e} m, of the spheres 8e-5"
    );
}

#[test]
fn solid_fractions_that_a_run_has_written_give_the_same_run_again() {
    let mut budget = Budget::oracle(163_840);
    let folder = Folder::new("round_trip");
    let grains =
        "[[grains]]\nkind = \"sphere\"\ncentre = [5.1e-5, 4.9e-5, 5.3e-5]\ndiameter = 7.7e-5\n";
    let populations = |scene: &Scene, budget: &mut Budget| {
        budget.spend(20 * 4096);
        let mut engine = open(EngineName::Reference, scene, None, false).unwrap();
        engine.step(20).unwrap();
        let domain = &engine.setup().domain;
        let cells = engine.cells(Block::whole(domain));
        let bits = |cell: &psmrt::engine::CellState| {
            [cell.density, cell.velocity.x, cell.velocity.y, cell.velocity.z, cell.solid_fraction]
                .map(f64::to_bits)
        };
        (
            cells.iter().map(bits).collect::<Vec<_>>(),
            cells.iter().map(|cell| cell.solid_fraction).collect::<Vec<_>>(),
        )
    };
    let (before, fractions) = populations(&array_scene(&folder, grains), &mut budget);
    folder.write("solid.npy", array([16; 3], |[x, y, z]| fractions[x + 16 * (y + 16 * z)]));
    let image = "[[grains]]\nkind = \"voxels\"\nimage = { file = \"solid.npy\", voxel = 6.25e-6, grey = [0, 1] }\n";
    let (after, _) = populations(&array_scene(&folder, image), &mut budget);
    assert!(before == after, "a cell differs in a bit");
}

/// The cells of `cells` of which the map has a `#`, layer by layer along z.
fn map(layers: &[&str]) -> Vec<bool> {
    layers.concat().chars().map(|cell| cell == '#').collect()
}

#[test]
fn a_path_through_the_pores_ends_where_it_began_a_period_further_on() {
    let periodic = Domain::new([4, 4, 1], Faces::PERIODIC).unwrap();
    let open = [Face::Pressure { density: 1.0 }; 2];
    let open_ended = Domain::new([4, 4, 1], Faces { x: open, ..Faces::PERIODIC }).unwrap();
    for (name, layer, from_end_to_end, around) in [
        ("a straight channel", "####\n....\n####\n####", 4, 4),
        ("a channel that the ends close", "####\n#..#\n####\n####", 0, 0),
        ("a channel of which one end meets rock", "##..\n#.##\n..##\n####", 5, 0),
        ("a step over an edge, along the lattice", "##.#\n..#.\n####\n####", 4, 4),
        ("a dead end beside a channel", "####\n....\n#.##\n####", 5, 5),
    ] {
        let is_solid = map(&layer.lines().collect::<Vec<_>>());
        let all = is_solid.iter().filter(|solid| !**solid).count();
        for (domain, expected) in [(&open_ended, from_end_to_end), (&periodic, around)] {
            let found = pores(domain, &is_solid, 0);
            assert_eq!(
                found,
                Pores { all, through: expected },
                "{name}, periodic: {}",
                domain.is_periodic(0)
            );
        }
    }
}

#[test]
fn ends_of_an_image_that_do_not_fit_and_a_grid_that_is_too_coarse_are_told() {
    let folder = Folder::new("image_warnings");
    // Half a ball at x = 0, and nothing at the other end.
    let half = |[x, y, z]: [usize; 3]| {
        let squares = [x as f64 + 0.5, y as f64 - 5.5, z as f64 - 5.5].map(|along| along * along);
        f64::from(u8::from(squares.iter().sum::<f64>() < 20.0))
    };
    folder.write("half.npy", array([12; 3], half));
    let told = |cells: usize, more: &str| {
        let grains = format!(
            "[[grains]]\nkind = \"voxels\"\nimage = {{ file = \"half.npy\", voxel = 1e-5, solid = [1]{more} }}\n"
        );
        let dx = 12e-5 / cells as f64;
        let text = crate::scenes::water([cells; 3], dx, &format!("{grains}[stop]\nsteps = 1\n"));
        let text = if more.is_empty() {
            text
        } else {
            text.replacen(&format!("cells = {:?}\n", [cells; 3]), "", 1)
        };
        let scene = Scene::load(&folder.write("scene.toml", text), &[])
            .unwrap_or_else(|error| panic!("{error}"));
        let all = warnings(&scene);
        let has = |what: &str| all.iter().any(|warning| warning.reason.contains(what));
        [has("periodic face along x"), has("periodic face along y"), has("solid in part only")]
    };
    // Whatever the grid, as long as it resolves the image.
    for cells in [12, 24] {
        assert_eq!(told(cells, ""), [true, false, false], "on {cells} cells");
    }
    assert_eq!(told(12, ", mirror = [\"x\"]"), [false; 3]);
    assert!(told(3, "")[2], "on cells of four voxels");
}

#[test]
fn an_image_that_is_mirrored_comes_back_to_its_first_voxel() {
    let body = VoxelBody {
        first: [1, 0, 2],
        used: [3, 2, 2],
        is_mirrored: [true, false, true],
        ..body([5, 2, 4], |[x, y, z]| f64::from(u8::from((x + y + z) % 3 == 0)))
    };
    assert_eq!(body.counts(), [6, 2, 4]);
    let shown = |y: usize, z: usize| (0..6).map(|x| body.share([x, y, z])).collect::<Vec<_>>();
    for z in 0..2 {
        // Voxels 1, 2, 3 and then 3, 2, 1 of the row at z + 2.
        let expected = [1, 2, 3, 3, 2, 1].map(|x| f64::from(u8::from((x + 1 + z + 2) % 3 == 0)));
        assert_eq!(shown(1, z), expected, "row {z}");
        assert_eq!(shown(1, 3 - z), expected, "the mirror image of row {z}");
    }
}

#[test]
fn spheres_and_images_stand_beside_each_other() {
    let folder = Folder::new("beside");
    folder.write("plate.npy", array([16, 16, 2], |_| 1.0));
    let grains = |z: &str| {
        format!(
            "[[grains]]\nkind = \"sphere\"\ncentre = [5e-5, 5e-5, {z}]\ndiameter = 4e-5\n[[grains]]\nkind = \"voxels\"\n\
             image = {{ file = \"plate.npy\", voxel = 6.25e-6, solid = [1], corner = [0, 0, 8.75e-5] }}\n"
        )
    };
    let scene = array_scene(&folder, &grains("5e-5"));
    let solids = &scene.setup.solid_phase.as_ref().unwrap().solids;
    assert!(
        matches!(solids[0].shape, Shape::Sphere { .. })
            && matches!(solids[1].shape, Shape::Cells { .. })
    );
    assert_eq!(solids[1].volume(), 512.0);
    let text = fs::read_to_string(folder.path("scene.toml"))
        .unwrap()
        .replace("5e-5, 5e-5]", "5e-5, 7.5e-5]");
    let error =
        Scene::from_bytes("scene.toml", text.into_bytes(), Path::new(&folder.path("")), &[])
            .unwrap_err();
    assert!(error.to_string().contains("in common"), "{error}");
}
