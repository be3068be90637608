//! Grains from VTK's files of points: those that a run has written for ParaView, and those of other programs.

use std::fs;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use psmrt::scene::{Scene, SceneError};
use psmrt_reference::grains::grain::Grain;

use crate::cli::{Folder, psmrt_in, stderr};
use crate::common::Budget;
use crate::scenes::{FLOOR_AND_LID, GRAVITY, water};

const CELLS: [usize; 3] = [10, 8, 10];

/// Free grains from `list`, with what the section says besides.
fn scene(list: &str, more: &str) -> String {
    let rest = format!(
        "{FLOOR_AND_LID}{GRAVITY}[[grains]]\nkind = \"csv\"\nfile = \"{list}\"\nmotion = \"free\"\n{more}\
         [[records]]\nname = \"grains\"\nkind = \"grains\"\nevery_steps = 10\n[stop]\nsteps = 20\n"
    );
    water(CELLS, 1e-5, &rest)
}

/// Grains of different sizes and densities that move; one crosses the periodic face at x = 0.
const LIST: &str = "\
    x (m),y (m),z (m),diameter (m),density (kg/m3),velocity_x (m/s),velocity_y (m/s),velocity_z (m/s),spin_x (rad/s),\
    spin_y (rad/s),spin_z (rad/s)\n\
    1e-6,4e-5,7e-5,3e-5,2650,-0.02,0,0.001,10,-20,30\n\
    5e-5,4e-5,3.5e-5,4e-5,1800.5,0.01,0.002,-0.004,0,0,-50\n";

fn run(folder: &Folder, scene: &str, out: &str) {
    Budget::oracle(16_000).spend(20 * 10 * 8 * 10);
    let output = psmrt_in(&folder.path(""), &["run", scene, "--out", out]);
    assert!(output.status.success(), "{}", stderr(&output));
}

fn grains(folder: &Folder, name: &str) -> Vec<Grain> {
    let scene = Scene::load(&folder.path(name), &[]).unwrap_or_else(|error| panic!("{error}"));
    scene.free.unwrap().grains
}

#[test]
fn what_a_run_wrote_for_paraview_starts_another_with_the_same_grains() {
    let folder = Folder::new("points_again");
    folder.write("list.csv", LIST);
    folder.write("first.toml", scene("list.csv", ""));
    run(&folder, "first.toml", "first");
    folder.write("from_list.toml", scene("first/grains_at_end.csv", ""));
    folder.write("from_points.toml", scene("first/grains/grains_000000000020.vtp", ""));
    let (by_list, by_points) =
        (grains(&folder, "from_list.toml"), grains(&folder, "from_points.toml"));
    assert_eq!(by_list.len(), 2);
    for (list, points) in by_list.iter().zip(&by_points) {
        for (a, b) in [
            (list.position, points.position),
            (list.velocity, points.velocity),
            (list.angular_velocity, points.angular_velocity),
        ] {
            assert!((a - b).norm() <= 1e-13 * a.norm(), "{a} in the list, {b} in the points");
        }
        assert!((list.radius / points.radius - 1.0).abs() < 1e-14);
        assert!((list.mass / points.mass - 1.0).abs() < 1e-13);
        assert!(list.velocity.norm() > 0.0 && list.angular_velocity.norm() > 0.0);
    }
    run(&folder, "from_points.toml", "second");
    // The copy that a run keeps is what it is resumed from.
    let kept = fs::read(folder.path("second/grains_0.vtp")).unwrap();
    assert_eq!(kept, fs::read(folder.path("first/grains/grains_000000000020.vtp")).unwrap());
    let output = psmrt_in(&folder.path(""), &["check", "second/scene.toml"]);
    assert!(output.status.success(), "{}", stderr(&output));
}

/// How an array is stored, from its numbers as bytes and as text: its attributes, and what is inside it.
type Store<'a> = &'a mut dyn FnMut(&[u8], &str) -> (String, String);

/// A point file of two grains whose arrays are stored by `store`.
fn file(head: &str, store: Store<'_>, appended: &str) -> String {
    let mut array = |name: &str, components: usize, values: &[f64]| {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let text = values.iter().map(|value| format!("{value:?} ")).collect::<String>();
        let (attributes, inside) = store(&bytes, &text);
        format!(
            "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" {attributes}>\
             \n{inside}\n</DataArray>\n"
        )
    };
    let places = array("Points", 3, &[2.5e-5, 4e-5, 5e-5, 7.5e-5, 4e-5, 5e-5]);
    let sizes = array("diameter (m)", 1, &[4e-5, 4.5e-5]);
    let speeds = array("velocity (m/s)", 3, &[0.0, 0.01, 0.0, 0.0, 0.0, -0.02]);
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" {head}>\n<PolyData>\n\
         <Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
         <PointData>\n<DataArray type=\"Int64\" Name=\"grain\" format=\"ascii\">0 1</DataArray>\n{sizes}{speeds}</PointData>\n\
         <CellData></CellData>\n<Points>\n{places}</Points>\n</Piece>\n</PolyData>\n{appended}</VTKFile>\n"
    )
}

const HEAD: &str = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";

fn as_text(head: &str) -> String {
    file(head, &mut |_, text| ("format=\"ascii\"".to_owned(), text.to_owned()), "")
}

/// Bytes behind their number, in base64.
fn in_base64(bytes: &[u8], length: &[u8]) -> String {
    STANDARD.encode([length, bytes].concat())
}

fn as_base64(head: &str, is_wide: bool) -> String {
    let mut store = |bytes: &[u8], _: &str| {
        let length = (bytes.len() as u64).to_le_bytes();
        let inside = in_base64(bytes, if is_wide { &length } else { &length[..4] });
        ("format=\"binary\"".to_owned(), inside)
    };
    file(head, &mut store, "")
}

fn as_appended_base64() -> String {
    let mut data = String::new();
    let mut store = |bytes: &[u8], _: &str| {
        let attributes = format!("format=\"appended\" offset=\"{}\"", data.len());
        data += &in_base64(bytes, &(bytes.len() as u64).to_le_bytes());
        (attributes, String::new())
    };
    let elements = file(HEAD, &mut store, "PLACE");
    elements.replace(
        "PLACE",
        &format!("<AppendedData encoding=\"base64\">\n_{data}\n</AppendedData>\n"),
    )
}

fn load(folder: &Folder, points: impl AsRef<[u8]>) -> Result<Scene, Box<SceneError>> {
    folder.write("points.vtp", points);
    folder.write("scene.toml", scene("points.vtp", "density = 2650.0\n"));
    Scene::load(&folder.path("scene.toml"), &[])
}

#[test]
fn text_and_base64_give_the_grains_of_the_same_list() {
    let folder = Folder::new("points_alike");
    let text = as_text(HEAD);
    let grains = |points: &str| {
        let scene = load(&folder, points).unwrap_or_else(|error| panic!("{error}\n{points}"));
        scene.free.unwrap().grains
    };
    let wanted = grains(&text);
    assert_eq!(wanted.len(), 2);
    assert!((wanted[1].radius - 2.25).abs() < 1e-12 && wanted[1].velocity.z < 0.0);
    let narrow = HEAD.replace("UInt64", "UInt32");
    for points in [
        format!("\u{feff}{}", text.replace('\n', "\r\n")),
        as_base64(HEAD, true),
        as_base64(&narrow, false),
        as_appended_base64(),
        // Numbers in text have no order of bytes.
        as_text(&HEAD.replace("Little", "Big")),
        text.replace("PolyData", "UnstructuredGrid"),
        // Two pieces.
        text.replace("</Piece>", "</Piece><Piece NumberOfPoints=\"0\"></Piece>"),
        // As LIGGGHTS calls them.
        text.replace("diameter (m)", "diameter").replace("velocity (m/s)", "v"),
        text.replace("diameter (m)", "radius").replace("4e-5 4.5e-5", "2e-5 2.25e-5"),
    ] {
        assert!(grains(&points) == wanted, "other grains from\n{points}");
    }
}

/// A file with radii that are not half of its diameters, so often.
fn with_radii(text: &str, times: usize) -> String {
    let radii =
        "<DataArray type=\"Float64\" Name=\"radius (m)\" format=\"ascii\">1e-5 1e-5</DataArray>\n";
    text.replace("<PointData>\n", &format!("<PointData>\n{}", radii.repeat(times)))
}

#[test]
fn point_files_that_are_not_read_are_refused_with_the_reason_and_a_remedy() {
    let folder = Folder::new("points_wrong");
    let text = as_text(HEAD);
    let zipped = format!("{HEAD} compressor=\"vtkZLibDataCompressor\"");
    for (points, told, remedy) in [
        (as_base64(&zipped, true), "compressed (vtkZLibDataCompressor)", "Compressor Type None"),
        (as_base64(&HEAD.replace("Little", "Big"), true), "big-endian", "Data Mode Ascii"),
        (as_base64(HEAD, true).replace("Float64", "Int32"), "of type \"Int32\"", "Float64"),
        (text.replace("type=\"PolyData\"", "type=\"ImageData\""), "of kind \"ImageData\"", ".vtp"),
        ("<?xml version=\"1.0\"?>\n<html></html>".to_owned(), "XML of kind \"html\"", ".vtp"),
        (text[..text.len() - 30].to_owned(), "no valid XML", "cut off"),
        (text.replace("diameter (m)", "size"), "no array \"diameter (m)\"", "radius (m)"),
        (text.replace("4e-5 4.5e-5", "4e-5"), "array \"diameter (m)\" has 1 values", "cut off"),
        (
            text.replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"2.0\""),
            "it has \"2.0\" points",
            "anew",
        ),
        (with_radii(&text, 1), "a radius that is not half of it", "leave one"),
        (with_radii(&text, 2), "array \"radius (m)\" twice", "anew"),
        (text.replace("4e-5 4.5e-5", "4e-5 0"), "point 1 (from 0): diameter (m) = 0", "above 0"),
        (text.replace("4e-5 4.5e-5", "4e-5 0,5"), "\"0,5\" is no number", "points"),
        (text.replace("4e-5 4.5e-5", "4e-5 nan"), "point 1 (from 0)", "finite"),
        (
            text.replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"0\""),
            "no points",
            "a point a grain",
        ),
        (
            text.replace("NumberOfPoints=\"2\"", "NumberOfPoints=\"3\""),
            "3 points of 3 need 9",
            "cut off",
        ),
        (
            text.replace("ascii\">\n4e-5 4", "zip\">\n4e-5 4"),
            "stored as \"zip\"",
            "Data Mode Ascii",
        ),
        (as_appended_base64().replace("offset=\"0\"", "offset=\"99999\""), "is cut off", "anew"),
    ] {
        let error = *load(&folder, &points).expect_err(&points);
        assert_eq!(error.key, "grains[0].file", "{error}");
        assert!(error.problem.contains("points.vtp"), "{error}");
        assert!(error.problem.contains(told), "no {told:?} in\n{error}");
        assert!(error.remedy.contains(remedy), "no {remedy:?} in\n{error}");
    }
}

#[test]
fn no_change_of_a_byte_of_a_point_file_is_worse_than_refused() {
    let folder = Folder::new("points_mangled");
    for points in [as_text(HEAD), as_base64(HEAD, true), as_appended_base64()] {
        for at in (0..points.len()).step_by(7) {
            let mut bytes = points.clone().into_bytes();
            bytes[at] = b'9';
            let cut = &points.as_bytes()[..at];
            for changed in [bytes.as_slice(), cut] {
                match load(&folder, changed) {
                    Err(error) => assert!(error.to_string().contains("help: "), "{error}"),
                    // A digit of a number, say; no grain gets lost.
                    Ok(scene) => {
                        assert_eq!(scene.free.map(|part| part.grains.len()), Some(2), "byte {at}");
                    }
                }
            }
        }
    }
}
