//! What `psmrt check` and `psmrt plan` predict, against exact series and against runs that no model was fitted to.

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::Budget;
use psmrt::advice::estimate::speed::{Try, seconds_per_step};
use psmrt::advice::estimate::{numbers, warnings};
use psmrt::advice::plan::duct::Duct;
use psmrt::advice::plan::facts::{Facts, Limit};
use psmrt::advice::plan::options::{Speed, as_it_is, cheapest, options};
use psmrt::advice::plan::write::text;
use psmrt::advice::tradeoff::model::SolidMethod;
use psmrt::advice::tradeoff::models::Models;
use psmrt::engine::{Block, EngineName, open};
use psmrt::scene::Scene;
use psmrt::table::Table;
use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::rates::Rates;
use std::time::Duration;

fn golden(file: &str) -> Table {
    Table::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(file)).unwrap()
}

fn scene(text: &str) -> Scene {
    Scene::from_bytes("scene.toml", text.as_bytes().to_vec(), Path::new("."), &[])
        .unwrap_or_else(|error| panic!("{error}"))
}

fn models() -> &'static Models {
    Models::committed().unwrap()
}

fn oracle() -> Speed {
    Speed { engine: EngineName::Reference, mrt: 1.0, srt: 1.0 }
}

#[test]
fn mean_velocities_of_ducts_agree_with_the_tabulated_series() {
    let table = golden("duct/literature.csv");
    for (aspect, mean) in
        table.points("aspect_short_over_long", "umean_mu_over_G_shortside2").unwrap()
    {
        let found = Duct::new(1.0 / aspect).mean;
        // Twelve digits are printed; 200 odd terms that fall as k^-5 leave 1e-12.
        assert!((found / mean - 1.0).abs() < 1e-9, "ratio {aspect}: {found} instead of {mean}");
    }
}

#[test]
fn measured_errors_of_ducts_lie_within_the_predicted_band() {
    let rows = golden("duct/expected.csv");
    let collision = |word: &str| Preset::from_word(word).unwrap().collision(0.8).unwrap();
    let square = Duct::new(1.0);
    for row in &rows.rows {
        let (cells, measured): (f64, f64) = (row[2].parse().unwrap(), row[3].parse().unwrap());
        let (error, [low, high]) = square.error(&collision(&row[1]), cells);
        assert!(
            (low..=high).contains(&measured),
            "{} at {cells} cells: measured {measured:e}, predicted {error:e} ({low:e} to {high:e})",
            row[1]
        );
        // The closed form is of second order: the next is a tenth of it at most here, whatever the band.
        let sizes = measured.abs().max(1.0 / (cells * cells));
        assert!((error - measured).abs() < 0.1 * sizes, "{row:?}: predicted {error:e}");
    }
    // The scene that was promised "< 0.001 %": measured from outside, with the magic rates at tau = 2.
    let magic = Collision::Mrt { rates: Rates::magic(2.0, 3.0 / 16.0).unwrap() };
    let (error, [low, high]) = square.error(&magic, 6.0);
    assert!((low..=high).contains(&0.0240), "6 cells: {error} ({low} to {high}) for 0.0240");
}

#[test]
fn planned_ducts_err_as_promised() {
    let mut budget = Budget::oracle(60_000);
    for (ratio, aspect, wanted) in [(1.0, "1", 0.03), (2.0, "0.5", 0.02)] {
        let mean = golden("duct/literature.csv").with(&[("aspect_short_over_long", aspect)]);
        let mean = mean.unwrap().number("umean_mu_over_G_halfshort2").unwrap();
        let changes = [format!("domain.size=[62.5e-6, 1e-3, {:e}]", ratio * 1e-3)];
        let duct = Scene::load(Path::new("golden/duct/scene.toml"), &changes).unwrap();
        let facts = Facts::of(&duct).unwrap().unwrap();
        let all = options(&facts, models(), &[oracle()]);
        let all: Vec<_> =
            all.into_iter().filter(|option| option.collision == Preset::Trt).collect();
        let best = cheapest(&all, wanted).unwrap();
        let planned = text(&duct, Path::new(""), best, "").unwrap();
        let planned =
            Scene::from_bytes("planned", planned.into_bytes(), Path::new(""), &[]).unwrap();
        let mut engine = open(EngineName::Reference, &planned, None, false).unwrap();
        // The slowest part falls by e in h²/(2 ν (π/2)²) = 0.05 s; 12 times that leaves 6e-6.
        let steps = (0..).find(|&n| f64::from(n) * planned.units.si_dt > 0.6).unwrap();
        engine.step(u64::try_from(steps).unwrap()).unwrap();
        budget.spend(planned.setup.domain.cell_count() as u64 * u64::try_from(steps).unwrap());
        let means = engine.box_means();
        let si_mean = means.mass_flux.x / means.density * planned.units.si_velocity();
        // G h²/ν with h = 0.5 mm
        let error = si_mean / (mean * 0.02 * 0.25e-6 / 1e-6) - 1.0;
        let [low, high] = best.band;
        assert!(
            (low..=high).contains(&error.abs()),
            "duct {ratio} times as wide: measured {error:.5}, promised {:.5} ({low:.5} to {high:.5})",
            best.error
        );
    }
}

#[test]
fn walls_that_no_rule_covers_are_not_planned() {
    let base = "[domain]\ncells = [8, 8, 8]\ndx = 1e-5\n[fluid]\ndensity = 1000.0\n\
                kinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[stop]\nsteps = 10\n[faces]\n";
    let walls = |axis: &str| format!("{axis}_low.kind = \"wall\"\n{axis}_high.kind = \"wall\"\n");
    let [x, y, z] = ["x", "y", "z"].map(walls);
    let force = |a: &str| format!("[body_force]\nacceleration = {a}\n");
    let pressure = "x_low = { kind = \"pressure\", pressure = 1.0 }\nx_high = { kind = \"pressure\", \
                    pressure = 0.0 }\n";
    let why = |text: String| Facts::of(&scene(&format!("{base}{text}"))).unwrap();
    for (text, word) in [
        (format!("{y}{pressure}"), "enters or leaves"),
        (format!("{y}{z}{}", force("[0.0, 1e-3, 0.0]")), "along two axes"),
        (format!("{y}{z}"), "along two axes"),
        (format!("{x}{y}{z}"), "walls on all sides"),
    ] {
        let found = why(text.clone()).map(|facts| facts.limit);
        assert!(found.as_ref().is_err_and(|why| why.contains(word)), "{text}: {found:?}");
    }
    let duct = why(format!("{y}{z}{}", force("[1e-3, 0.0, 0.0]"))).unwrap();
    assert!(matches!(duct.limit, Limit::Duct { ratio, .. } if ratio == 1.0), "{:?}", duct.limit);
    // A mirror in the middle: half of the flow, and twice as many cells from wall to wall.
    let half = "y_low.kind = \"free_slip\"\ny_high.kind = \"wall\"\n".to_owned();
    let half = why(half + &force("[1e-3, 0.0, 0.0]")).unwrap();
    assert_eq!(half.limit, Limit::Plates { cells: 16.0 });
}

/// Couette flow between plates 8 cells apart, with a number of the scene's rates.
fn couette(model: &str, speed: f64) -> Scene {
    // dx/dt = 1 m/s at tau = 0.8: the speed is in cells per step too.
    scene(&format!(
        "[domain]\ncells = [1, 8, 1]\ndx = 1e-5\n[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6\n\
         [time]\ndt = 1e-5\n[collision]\nmodel = \"{model}\"\n[stop]\nsteps = 1500\n[faces]\n\
         y_low.kind = \"wall\"\ny_high = {{ kind = \"wall\", velocity = [{speed:e}, 0.0, 0.0] }}\n"
    ))
}

#[test]
fn couette_flow_is_told_the_error_of_its_own_profile_and_errs_by_no_more() {
    let mut budget = Budget::oracle(24_000);
    for (model, speed) in [("srt", 0.1), ("mrt", 0.1)] {
        let scene = couette(model, speed);
        let said = numbers(&scene).into_iter().find(|number| number.name == "predicted error");
        let said = said.unwrap();
        assert!(said.note.contains("of the profile") && !said.note.contains("force"), "{said:?}");
        let facts = Facts::of(&scene).unwrap().unwrap();
        let collision = Preset::of(&scene.setup.collision).unwrap();
        let option = as_it_is(&facts, models(), collision, &oracle()).unwrap();
        // Steady: the slowest part falls by e in h²/(π² ν) = 65 steps.
        let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
        engine.step(1500).unwrap();
        budget.spend(1500 * 8);
        let cells = engine.cells(Block::plane(&scene.setup.domain, 0));
        let exact = |i: usize| speed * (i as f64 + 0.5) / 8.0;
        let off: f64 =
            cells.iter().enumerate().map(|(i, c)| (c.velocity.x - exact(i)).powi(2)).sum();
        let whole: f64 = (0..8).map(|i| exact(i).powi(2)).sum();
        let measured = (off / whole).sqrt();
        println!("{model}: {measured:e}, predicted {} {:?}", option.error, option.band);
        assert!(measured <= option.band[1], "{model}: off by {measured:e}, told {:?}", option.band);
    }
    let rest = couette("srt", 0.0);
    let why = Facts::of(&rest).unwrap().unwrap_err();
    assert!(why.contains("neither a force nor a moving wall"), "{why}");
}

/// Spheres of 8 cells that touch in a cubic array, as scene text, shifted along z.
fn stacked(layers: u32, shift: f64) -> String {
    let mut grains = String::new();
    for k in 0..layers {
        for j in 0..4 {
            for i in 0..4 {
                let at = [i, j, k].map(|n| (f64::from(n) + 0.5) * 8e-5);
                let z = (at[2] + shift) % 6.4e-4;
                grains += &format!(
                    "[[grains]]\nkind = \"sphere\"\ncentre = [{:e}, {:e}, {z:e}]\ndiameter = 8e-5\n",
                    at[0], at[1]
                );
            }
        }
    }
    grains
}

fn stack(cells: u32, faces: &str, grains: &str) -> Scene {
    scene(&format!(
        "[domain]\ncells = [32, 32, {cells}]\ndx = 1e-5\n[fluid]\ndensity = 1000.0\n\
         kinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[stop]\nsteps = 10\n[faces]\n{faces}\
         [body_force]\nacceleration = [1e-3, 0.0, 0.0]\n{grains}"
    ))
}

#[test]
fn a_bed_with_clear_water_above_it_is_as_tight_as_the_bed() {
    let drag = |scene: &Scene| match Facts::of(scene).unwrap().unwrap().limit {
        Limit::Grains { drag, because, .. } => (drag, because),
        limit => panic!("{limit:?}"),
    };
    let walls = "z_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";
    // Spheres that touch in a cubic array fill π/6; the box of twice the height half of that.
    let (full, because) = drag(&stack(32, "", &stacked(4, 0.0)));
    assert!(because.contains("0.524, like the grains"), "{because}");
    for (faces, shift) in [(walls, 0.0), ("", 0.0), ("", 4.4e-4), (walls, 1.6e-4)] {
        let half = stack(64, faces, &stacked(4, shift));
        let (found, because) = drag(&half);
        let there = numbers(&half).into_iter().find(|number| number.name == "solid fraction there");
        let there = there.unwrap_or_else(|| panic!("no bed is found at {shift}")).value;
        // Its ends are found to an eighth of a diameter, of 4 diameters, by a line between two points.
        assert!((there / (PI / 6.0) - 1.0).abs() < 0.02, "{there} at {shift}, for {}", PI / 6.0);
        assert!((found / full - 1.0).abs() < 0.1, "{found} for {full}: {because}");
        assert!(because.contains("the whole domain has 0.262"), "{because}");
    }
    // Neither an even array nor a few grains in clear water are a bed.
    let two = stacked(1, 0.0)
        .split("[[grains]]")
        .skip(1)
        .take(2)
        .fold(String::new(), |all, one| all + "[[grains]]" + one);
    let lone = stack(64, walls, &two);
    for even in [stack(32, "", &stacked(4, 0.0)), stack(64, "", &stacked(8, 0.0)), lone] {
        let there = numbers(&even).into_iter().find(|number| number.name == "solid fraction there");
        assert_eq!(there, None);
    }
}

/// Sand of 0.2 mm at porosity 0.401 in a box of 1 mm, as far as a prediction sees it: an array that is as
/// crowded. The edges of its four spheres a cell are not 1 mm.
fn sand(cells_across: f64, tau: f64) -> Scene {
    // Face-centred: 4 spheres in a cube, c = 4 π d³/(6 a³); N cells along a side.
    let side = 2e-4 * (4.0 * PI / 6.0 / 0.599_f64).cbrt();
    let cells = (side / 2e-4 * cells_across * 3.0).round();
    scene(&format!(
        "[domain]\nsize = [{0:e}, {0:e}, {0:e}]\ndx = {1:e}\n[fluid]\ndensity = 1000.0\n\
         kinematic_viscosity = 1e-6\n[time]\ntau = {tau}\n[stop]\nsteps = 10\n[body_force]\n\
         acceleration = [1e-2, 0.0, 0.0]\n[[grains]]\nkind = \"array\"\nlattice = \"fcc\"\n\
         solid_fraction = 0.599\ncounts = [3, 3, 3]\n[solid]\noperator = \"bounce_back\"\n",
        3.0 * side,
        3.0 * side / cells
    ))
}

fn predicted(scene: &Scene) -> f64 {
    let number = numbers(scene).into_iter().find(|number| number.name == "predicted error");
    number.expect("an error is predicted").value / 100.0
}

#[test]
fn permeabilities_of_sand_agree_once_the_predicted_error_is_taken_off() {
    // Measured from outside: cells, tau, permeability (m2). They lie between 4.19e-11 and 9.2e-11; its true
    // one is not known, and must be one.
    let measured =
        [(8.0, 0.8, 9.2e-11), (10.0, 0.8, 7.35e-11), (10.0, 0.6, 5.76e-11), (8.0, 0.51, 4.19e-11)];
    for (cells, tau, permeability) in measured {
        let error = predicted(&sand(cells, tau));
        let corrected = permeability / (1.0 + error);
        // Bands are a quarter of the error: of 1.21 that is 14 % of the flow; all lie within half of that.
        assert!(
            (corrected / 4.2e-11 - 1.0).abs() < 0.07,
            "{cells} cells, tau {tau}: {permeability:e} less {:.0} % are {corrected:e} m2, not 4.2e-11",
            100.0 * error
        );
    }
}

#[test]
fn beds_of_the_seepage_study_lie_within_their_bands() {
    // The random packing of 31 spheres, which at tau of 0.6 and more no model was fitted to. Its permeability
    // is that of the finest grid near tau = 1/2, good to 2 %.
    let table = golden("seepage/study.csv");
    let own = [
        ("collision", Preset::DHumieres.word()),
        ("weighting", "noble_torczynski"),
        ("packing", "random 3"),
    ];
    let own = table.with(&own).unwrap().with(&[("seed", "1"), ("Re_wanted", "1")]).unwrap();
    let fine = own.with(&[("cells_per_diameter", "16.0000"), ("tau", "0.51")]).unwrap();
    let exact = fine.number("permeability_d2").unwrap();
    let drag = 1.0 / (18.0 * (1.0 - 0.39883) * exact);
    for tau in ["0.503", "0.505", "0.51", "0.52", "0.55", "0.6", "0.8", "1"] {
        let row = own.with(&[("cells_per_diameter", "8.0000"), ("tau", tau)]).unwrap();
        let row = row.with(&[("engine", "reference")]).unwrap();
        let error = row.number("permeability_d2").unwrap() / exact - 1.0;
        let method = (Preset::DHumieres, SolidMethod::Usual);
        let found = models().with_grains(method, 8.0, tau.parse().unwrap(), drag).unwrap();
        let [low, high] = found.band;
        assert!(
            (low - 0.02..=high + 0.02).contains(&error),
            "tau {tau}: measured {error:.3}, predicted {:.3} ({low:.3} to {high:.3})",
            found.error
        );
    }
}

/// The value of a key in the words of a remedy.
fn value_of(remedy: &str, key: &str) -> Option<String> {
    let rest = remedy.split_once(&format!("`{key}` = "))?.1;
    Some(rest.split([' ', ',', ';']).next()?.to_owned())
}

#[test]
fn predicted_errors_are_warned_of_and_the_remedy_helps() {
    for (cells, tau) in [(8.0, 0.8), (10.0, 0.6), (6.0, 1.5), (3.0, 0.8), (8.0, 2.5), (8.0, 0.5005)]
    {
        let sand = sand(cells, tau);
        let found = warnings(&sand);
        let due = found.iter().find(|warning| warning.reason.contains("predicted"));
        let due = due.unwrap_or_else(|| panic!("{cells} cells, tau {tau}: {found:?}"));
        let changes: Vec<String> = ["domain.dx", "time.tau"]
            .into_iter()
            .filter_map(|key| Some(format!("{key}={}", value_of(&due.remedy, key)?)))
            .collect();
        assert!(!changes.is_empty(), "{}", due.remedy);
        let text = sand.text.clone().into_bytes();
        let helped = Scene::from_bytes("helped", text, Path::new("."), &changes)
            .unwrap_or_else(|error| panic!("{}: {error}", due.remedy));
        // Where two errors cancel a coarse grid looks good: that is no help.
        assert!(helped.units.si_dx <= sand.units.si_dx * (1.0 + 1e-9), "{}", due.remedy);
        let left = warnings(&helped);
        let left = left.iter().find(|warning| warning.reason.contains("predicted"));
        assert_eq!(left, None, "after {changes:?}, {} helps no more", due.remedy);
    }
    // A sphere of 6 cells at tau = 0.528 was told "tens of percent" for an error of 3 %.
    let sphere = Scene::load(
        Path::new("golden/stokes_settling/scene.toml"),
        &["domain.dx=8.333333333333333e-6", "time.tau=0.528"].map(str::to_owned),
    );
    let sphere = sphere.unwrap();
    assert!(predicted(&sphere).abs() < 0.05, "{}", predicted(&sphere));
    assert!(warnings(&sphere).iter().all(|warning| !warning.reason.contains("predicted")));
}

fn scenes() -> Vec<PathBuf> {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let folders = fs::read_dir(golden).unwrap().map(|entry| entry.unwrap().path());
    let files = folders.filter(|path| path.is_dir()).flat_map(|path| fs::read_dir(path).unwrap());
    let mut files: Vec<PathBuf> = files.map(|entry| entry.unwrap().path()).collect();
    // Those of the paper's own size take minutes to be packed; they are the small ones with more grains.
    files.retain(|path| {
        path.extension().is_some_and(|extension| extension == "toml")
            && !path.ends_with("paper.toml")
    });
    files.sort();
    files
}

#[test]
fn check_and_plan_say_the_same_of_every_golden_scene() {
    let mut compared = 0;
    for file in scenes() {
        let name = file.display();
        // Scenes that are completed by a case cannot be loaded alone.
        let Ok(scene) = Scene::load(&file, &[]) else { continue };
        let said = numbers(&scene).into_iter().find(|number| number.name == "predicted error");
        let warned = warnings(&scene);
        let warned = warned.iter().any(|warning| {
            warning.reason.contains("is predicted to be")
                || warning.reason.contains("are predicted to")
        });
        let Ok(facts) = Facts::of(&scene).unwrap() else {
            assert_eq!(said, None, "{name}: plan knows of no error");
            continue;
        };
        let collision = Preset::of(&scene.setup.collision).unwrap();
        match as_it_is(&facts, models(), collision, &oracle()) {
            Ok(option) => {
                let said = said.unwrap_or_else(|| panic!("{name}: check says nothing")).value;
                let off = (said.abs() / 100.0 - option.error).abs();
                assert!(off < 1e-12, "{name}: check says {said} %, plan {}", option.error);
                assert_eq!(warned, option.error > 0.1, "{name}: {said} %");
                compared += 1;
            }
            Err(outside) => {
                let said = said.map(|number| number.note).unwrap_or_default();
                assert!(said.is_empty() || said.contains(&outside.why), "{name}: {said}");
            }
        }
    }
    assert!(compared >= 8, "only {compared} scenes were compared");
}

#[test]
fn times_are_those_of_the_processor_and_of_the_best_try_not_of_a_busy_clock() {
    let ms = Duration::from_millis;
    let one = |steps, clock, processor: Option<u64>| Try {
        steps,
        clock: ms(clock),
        processor: processor.map(ms),
    };
    let near = |found: Option<[f64; 2]>, wanted: [f64; 2]| {
        let found = found.unwrap();
        let is =
            found.iter().zip(wanted).all(|(found, wanted)| (found / wanted - 1.0).abs() < 1e-9);
        assert!(is, "{found:?} instead of {wanted:?} seconds per step");
    };
    // Ten steps of 10 ms of the processor in 100 ms, then in a second: the others had the rest.
    near(seconds_per_step(&[one(10, 100, Some(100)), one(10, 1000, Some(100))]), [0.01, 0.055]);
    near(seconds_per_step(&[one(10, 1000, Some(100)), one(10, 2000, Some(100))]), [0.01, 0.15]);
    // Two threads at once, alone on the machine: the clock runs half as fast as the processor's time.
    near(seconds_per_step(&[one(10, 100, Some(200)), one(10, 100, Some(200))]), [0.01, 0.01]);
    // On a device, or where no processor time is known, the best try counts.
    near(seconds_per_step(&[one(10, 100, None), one(10, 700, None)]), [0.01, 0.04]);
    assert_eq!(seconds_per_step(&[]), None);
}
