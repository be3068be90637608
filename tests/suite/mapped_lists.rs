//! Tables of other programs as lists of grains: the scene says which of their columns is what, and in which unit.

use crate::cli::Folder;
use psmrt::scene::{Scene, SceneError};

/// The grain of the scene of wrong scenes that a list stands for here.
const SPHERE: &str = "kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4";

/// A scene whose first grain is from a list with these `columns`.
fn load(folder: &Folder, columns: &str, list: &str) -> Result<Scene, Box<SceneError>> {
    folder.write("table.txt", list);
    let good = include_str!("bad_scenes/good.toml");
    assert!(good.contains(SPHERE));
    let section = format!("kind = \"csv\"\nfile = \"table.txt\"\ncolumns = {{ {columns} }}");
    folder.write("scene.toml", good.replace(SPHERE, &section));
    Scene::load(&folder.path("scene.toml"), &[])
}

const IN_MM: &str =
    "x = \"X [mm]\", y = \"Y [mm]\", z = \"Z [mm]\", radius = \"R [mm]\", lengths_in = 1e-3";

const PLAIN: &str = "x = \"x\", y = \"y\", z = \"z\", diameter = \"d\"";

#[test]
fn tables_of_other_programs_give_the_same_grains_by_the_names_of_their_columns() {
    let folder = Folder::new("mapped_alike");
    let good = include_str!("bad_scenes/good.toml");
    folder.write("scene.toml", good);
    let standard = Scene::load(&folder.path("scene.toml"), &[]).unwrap().setup;
    let delimited = |columns: &str, name: &str| format!("{columns}, delimiter = \"{name}\"");
    let in_mm = "Id,X [mm],Y [mm],Z [mm],R [mm],Material\n7,0.3,0.25,0.25,0.1,quartz\n".to_owned();
    for (columns, list) in [
        (IN_MM.to_owned(), in_mm.clone()),
        // As a spreadsheet saves it: a byte-order mark, and lines that end in CR LF.
        (
            delimited(IN_MM, "semicolon"),
            format!("\u{feff}{}", in_mm.replace(',', ";").replace('\n', "\r\n")),
        ),
        (delimited(IN_MM, "tab"), in_mm.replace(',', "\t")),
        (
            delimited(PLAIN, "blanks"),
            "# a comment\n\n  id  x y   z\td \n 1  3e-4 2.5e-4   2.5e-4\t2e-4 \n".to_owned(),
        ),
        (
            delimited(PLAIN, "blanks"),
            "\"my id\" z x y d\n\"1 a\" 2.5e-4 3e-4 2.5e-4 2e-4\n".to_owned(),
        ),
        // Units that names say, each its own, go before the one of all names; there are two signs for micro.
        (
            "x = \"X [mm]\", y = \"Y (\u{b5}m)\", z = \"Z [\u{3bc}m]\", diameter = \"d\", lengths_in = 1e-4".to_owned(),
            "X [mm],Y (\u{b5}m),Z [\u{3bc}m],d\n0.3,250,250,2\n".to_owned(),
        ),
        // Names that are our own are as good as others.
        (
            "x = \"x (m)\", y = \"y (m)\", z = \"z (m)\", diameter = \"diameter (m)\"".to_owned(),
            "x (m),y (m),z (m),diameter (m),colour\n3e-4,2.5e-4,2.5e-4,2e-4,red\n".to_owned(),
        ),
    ] {
        let setup =
            load(&folder, &columns, &list).unwrap_or_else(|error| panic!("{error}\n{list}")).setup;
        let solids =
            |setup: &psmrt_reference::setup::Setup| setup.solid_phase.clone().unwrap().solids;
        for (found, wanted) in solids(&setup).iter().zip(&solids(&standard)) {
            // 0.3 times 1e-3 is not the last digit of 3e-4.
            assert!((found.centre - wanted.centre).norm() < 1e-12, "{list}{found:?}");
            assert!((found.diameter() - wanted.diameter()).abs() < 1e-12, "{list}{found:?}");
        }
    }
}

#[test]
fn densities_and_motions_of_a_table_are_taken_in_its_units() {
    let folder = Folder::new("mapped_motion");
    let columns = "x = \"x\", y = \"y\", z = \"z\", diameter = \"d\", density = \"rho\", velocity_x = \"u\", \
                   velocity_y = \"v\", velocity_z = \"w\", spin_x = \"p\", spin_y = \"q\", spin_z = \"r\", \
                   lengths_in = 1e-6, velocities_in = 1e-3, densities_in = 1000.0";
    let list = "x,y,z,d,rho,u,v,w,p,q,r\n300,250,250,200,2.65,1,-2,3,4,5,-6\n";
    folder.write("table.txt", list);
    let text = include_str!("bad_scenes/good.toml");
    let section = format!(
        "kind = \"csv\"\nfile = \"table.txt\"\nmotion = \"free\"\ncolumns = {{ {columns} }}"
    );
    folder.write("scene.toml", text.replace(SPHERE, &section));
    let scene =
        Scene::load(&folder.path("scene.toml"), &[]).unwrap_or_else(|error| panic!("{error}"));
    let grain = scene.free.as_ref().unwrap().grains[0];
    let units = scene.units;
    let near = |found: f64, wanted: f64| {
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found} where {wanted} was given");
    };
    near(grain.radius * units.si_dx, 1e-4);
    near(grain.mass / (4.0 / 3.0 * std::f64::consts::PI * grain.radius.powi(3)), 2.65);
    for (axis, wanted) in [1e-3, -2e-3, 3e-3].into_iter().enumerate() {
        near(grain.velocity[axis] * units.si_velocity(), wanted);
    }
    for (axis, wanted) in [4.0, 5.0, -6.0].into_iter().enumerate() {
        near(grain.angular_velocity[axis] * units.si_angular_velocity(), wanted);
    }
}

/// Columns, a list, the key to blame, what is said, and what to do about it.
type Row = (&'static str, &'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const WRONG: &[Row] = &[
    (PLAIN, "# made by hand\nx,y,d\n1,2,3\n", "columns.z", "table.txt, line 2: there is no column \"z\"", "its columns are \"x\", \"y\", \"d\""),
    (PLAIN, "x;y;z;d\n1;2;3;4\n", "columns.x", "line 1: there is no column \"x\"", "`delimiter = \"semicolon\"`"),
    (PLAIN, "x\ty\tz\td\n1\t2\t3\t4\n", "columns.x", "line 1: there is no column \"x\"", "`delimiter = \"tab\"`"),
    (PLAIN, "x y z d\n1 2 3 4\n", "columns.x", "line 1: there is no column \"x\"", "`delimiter = \"blanks\"`"),
    (PLAIN, "3e-4,2.5e-4,2.5e-4,2e-4\n", "columns.x", "no column \"x\"", "put a line with them above"),
    (PLAIN, "x,y,z,d,x\n1,2,3,4,5\n", "columns.x", "\"x\" is there twice", "different names"),
    (PLAIN, "x,y,z,d\n3e-4,2.5e-4,2.5e-4,2e-4\n3e-4,two,2.5e-4,2e-4\n", "file", "table.txt, line 3: y = \"two\"", "finite numbers"),
    (PLAIN, "x,y,z,d\n3e-4,2.5e-4,2.5e-4,-2e-4\n", "file", "line 2: d = \"-2e-4\"", "above 0"),
    (PLAIN, "x,y,z,d\n3e-4,2.5e-4,2.5e-4\n", "file", "line 2: it has 3 values, the first line names 4", "separated by commas"),
    (PLAIN, "x,y,z,d\n0,0003,0,00025,0,00025,0,0002\n", "file", "line 2: it has 8 values", "decimals with points"),
    (PLAIN, "x,y,z,d\n", "file", "no grains in it", "a line for each"),
    (PLAIN, "# nothing\n", "file", "nothing in it", "each further line is a grain"),
    ("x = \"x\", y = \"y\", z = \"z\", diameter = \"d\", delimiter = \"semicolon\"", "x;y;z;d\n0,0003;0,00025;0,00025;0,0002\n", "file", "line 2: x = \"0,0003\"", "points: 0.0003"),
    ("x = \"x\", y = \"y\", z = \"z\", diameter = \"d\", delimiter = \"semicolon\"", "x;y;z;d\n;;;\n", "file", "only semicolons", "remove the line"),
    ("x = \"x\", y = \"x\", z = \"z\", diameter = \"d\"", "x,y,z,d\n1,2,3,4\n", "columns.y", "\"x\" is already x (m)", "a column once"),
    ("x = \"x\", y = \"y\", z = \"z\", diameter = \"d\", velocity_x = \"u [ft/s]\", velocity_y = \"v\", velocity_z = \"w\"", "x,y,z,d,u [ft/s],v,w\n1,2,3,4,5,6,7\n", "columns.velocity_x", "a unit that is not known", "`velocities_in`"),
    ("x = \"x\", y = \"y\", z = \"z\", diameter = \"d\", spin_x = \"p (rpm)\", spin_y = \"q\", spin_z = \"r\"", "x,y,z,d,p (rpm),q,r\n1,2,3,4,5,6,7\n", "columns.spin_x", "a unit that is not known", "angles in rad"),
    (PLAIN, "ITEM: TIMESTEP\n0\nITEM: ATOMS x y z radius\n3e-4 2.5e-4 2.5e-4 1e-4\n", "columns", "says itself", "remove `columns`"),
    (PLAIN, "#format x_y_z_r\n3e-4 2.5e-4 2.5e-4 1e-4\n", "columns", "says itself", "remove `columns`"),
    (PLAIN, "<?xml version=\"1.0\"?>\n<VTKFile/>\n", "columns", "says itself", "remove `columns`"),
];

#[test]
fn what_is_wrong_with_a_table_is_told_with_its_line_its_column_and_a_remedy() {
    let folder = Folder::new("mapped_wrong");
    let mut missing = Vec::new();
    for (columns, list, key, told, remedy) in WRONG {
        let error = *load(&folder, columns, list).expect_err(list);
        let is_told = error.problem.contains(told) && error.remedy.contains(remedy);
        if error.key != format!("grains[0].{key}") || !is_told {
            missing.push(format!("{list:?}: {key}, {told}, {remedy}:\n{error}"));
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
