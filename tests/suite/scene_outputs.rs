//! Fields and grains as files: what NumPy and VTK read is what was computed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;
use crate::scenes::{FLOOR_AND_LID, GRAVITY, free_sphere, water};

fn scene() -> String {
    let rest = r#"
[faces]
z_low.kind = "wall"
z_high = { kind = "wall", velocity = [1e-3, 0.0, 0.0] }
[[grains]]
kind = "sphere"
centre = [3e-4, 2e-4, 2e-4]
diameter = 2.5e-4
[[records]]
name = "fields"
kind = "fields"
formats = ["vti", "npy"]
every_steps = 20
[[records]]
name = "grains"
kind = "grains"
every_steps = 20
[stop]
steps = 40
"#;
    let free = free_sphere("[5.99e-4, 4e-4, 2.9e-4]", "2.1e-4", "2000.0");
    water([6, 5, 4], 1e-4, &format!("{rest}{free}"))
}

fn run(folder: &Folder) -> PathBuf {
    Budget::oracle(4_800).spend(40 * 6 * 5 * 4);
    let scene = folder.write("scene.toml", scene());
    let out = folder.path("out");
    let output = psmrt(&["run", scene.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    out
}

/// Shape and values of an array, read as numpy.lib.format describes it.
fn npy(path: &Path) -> (String, Vec<f64>) {
    let bytes = fs::read(path).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + length) % 64, 0);
    let header = String::from_utf8(bytes[10..10 + length].to_vec()).unwrap();
    assert!(header.contains("'<f8'") && header.ends_with('\n'), "{header}");
    let shape = header.split('(').nth(1).unwrap().split(')').next().unwrap();
    let values = bytes[10 + length..].chunks(8);
    (shape.to_owned(), values.map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect())
}

#[test]
fn arrays_have_the_shape_and_order_of_the_box() {
    let folder = Folder::new("npy");
    let out = run(&folder);
    let (shape, velocity) = npy(&out.join("fields/velocity_000000000040.npy"));
    assert_eq!(shape, "4, 5, 6, 3,");
    assert_eq!(velocity.len(), 4 * 5 * 6 * 3);
    // The upper wall (high z) drags the fluid along x; the last index runs over x, y, z.
    let mean = |z: usize, component: usize| {
        let plane = velocity[z * 90..(z + 1) * 90].iter().skip(component).step_by(3);
        plane.sum::<f64>() / 30.0
    };
    assert!(mean(3, 0) > 5.0 * mean(0, 0) && mean(3, 0) < 1e-3, "{}", mean(3, 0));
    assert!(mean(3, 0) > 100.0 * mean(3, 1).abs());
    let (shape, fraction) = npy(&out.join("fields/solid_fraction_000000000040.npy"));
    assert_eq!(shape, "4, 5, 6,");
    // The volume of the spheres, in cells.
    let volume = std::f64::consts::PI / 6.0 * (2.5_f64.powi(3) + 2.1_f64.powi(3));
    assert!((fraction.iter().sum::<f64>() / volume - 1.0).abs() < 1e-9);
}

#[test]
fn image_data_hold_the_same_values_in_single_precision() {
    let folder = Folder::new("vti");
    let out = run(&folder);
    let bytes = fs::read(out.join("fields/fields_000000000040.vti")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("WholeExtent=\"0 6 0 5 0 4\""), "{text:.400}");
    let at = bytes.windows(3).position(|w| w == b">\n_").unwrap() + 3;
    // Pressure comes first: its length in bytes, then its values.
    let length = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    assert_eq!(length, 120 * 4);
    let (_, pressure) = npy(&out.join("fields/pressure_000000000040.npy"));
    for (four, value) in bytes[at + 8..].chunks(4).zip(pressure) {
        let found = f64::from(f32::from_le_bytes(four.try_into().unwrap()));
        assert!((found - value).abs() <= 0.5 * f64::from(f32::EPSILON) * value.abs());
    }
    let series = fs::read_to_string(out.join("fields.pvd")).unwrap();
    for step in ["000000000000", "000000000020", "000000000040"] {
        assert!(series.contains(&format!("file=\"fields/fields_{step}.vti\"")), "{series}");
        assert!(out.join(format!("fields/fields_{step}.vti")).exists());
        assert!(out.join(format!("grains/grains_{step}.vtp")).exists());
    }
}

const PYTHON: &str = r#"
import sys, numpy as np, vtk
from vtk.util.numpy_support import vtk_to_numpy
folder = sys.argv[1]
def read(reader, path):
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path); reader.Update()
    assert not errors, errors
    return reader.GetOutput()
for step in ["000000000000", "000000000020", "000000000040"]:
    image = read(vtk.vtkXMLImageDataReader(), f"{folder}/fields/fields_{step}.vti")
    assert image.GetDimensions() == (7, 6, 5), image.GetDimensions()
    assert np.allclose(image.GetBounds(), (0, 6e-4, 0, 5e-4, 0, 4e-4))
    for name, file, shape in [("pressure (Pa)", "pressure", (4, 5, 6)),
                              ("velocity (m/s)", "velocity", (4, 5, 6, 3)),
                              ("solid fraction", "solid_fraction", (4, 5, 6))]:
        array = np.load(f"{folder}/fields/{file}_{step}.npy")
        assert array.shape == shape and array.dtype == np.float64
        cells = vtk_to_numpy(image.GetCellData().GetArray(name)).reshape(shape)
        assert np.array_equal(cells, array.astype(np.float32)), name
    grains = read(vtk.vtkXMLPolyDataReader(), f"{folder}/grains/grains_{step}.vtp")
    assert grains.GetNumberOfPoints() == grains.GetNumberOfVerts() == 2
    assert np.allclose(grains.GetPoint(0), (3e-4, 2e-4, 2e-4))
    assert np.isclose(vtk_to_numpy(grains.GetPointData().GetArray("diameter (m)"))[0], 2.5e-4)
    force = vtk_to_numpy(grains.GetPointData().GetArray("force (N)"))
    assert force.shape == (2, 3) and (step == "000000000000" or force[0, 0] > 0)
    # The free grain has drifted across the periodic face at x = 6e-4 and is shown inside the box.
    x = grains.GetPoint(1)[0]
    assert 0 <= x < 6e-4 and (step != "000000000040" or x < 1e-4), x
    assert vtk_to_numpy(grains.GetPointData().GetArray("contacts")).shape == (2,)
    assert vtk_to_numpy(grains.GetPointData().GetArray("contact force (N)")).shape == (2, 3)
pvd = open(f"{folder}/grains.pvd").read()
assert pvd.count("<DataSet") == 3 and "grains/grains_000000000040.vtp" in pvd
print("read by VTK", vtk.vtkVersion().GetVTKVersion(), "and NumPy", np.__version__)
"#;

#[test]
#[ignore = "needs Python with `pip install vtk numpy`"]
fn vtk_and_numpy_read_all_files() {
    let folder = Folder::new("python");
    let out = run(&folder);
    let output = Command::new("python3").args(["-c", PYTHON]).arg(&out).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("read by VTK"));
}

const PYTHON_OF_BEDS: &str = r#"
import sys, numpy as np, pandas as pd, vtk
from vtk.util.numpy_support import vtk_to_numpy
folder = sys.argv[1]
tables = {name: pd.read_csv(f"{folder}/{name}.csv") for name in ["layers", "walls", "contact_means", "loads"]}
for name, table in tables.items():
    assert list(table.columns[:2]) == ["time (s)", "step"] and len(table) > 0, (name, table.columns)
    numbers = table.drop(columns=["face"]) if "face" in table else table
    assert all(kind.kind in "fi" for kind in numbers.dtypes), (name, numbers.dtypes)
assert set(tables["walls"]["face"]) == {"z_low", "z_high"}
last = tables["walls"].iloc[-2:].set_index("face")
reader = vtk.vtkXMLPolyDataReader()
errors = []
reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
reader.SetFileName(f"{folder}/contacts/contacts_000000000400.vtp"); reader.Update()
assert not errors
lines = reader.GetOutput()
count, data = lines.GetNumberOfLines(), lines.GetCellData()
between = int(tables["contact_means"].iloc[-1]["contacts"])
assert (vtk_to_numpy(data.GetArray("other grain")) >= 0).sum() == between > 0, (count, between)
names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
normal = vtk_to_numpy(data.GetArray("normal force (N)"))
assert normal.shape == (count,) and (normal > 0).all(), normal
# What rests on the floor, by its own lines: those that end at z = 0.
points = vtk_to_numpy(lines.GetPoints().GetData())
ends = vtk_to_numpy(lines.GetLines().GetConnectivityArray()).reshape(count, 2)
floor = np.isclose(points[ends][:, :, 2].min(axis=1), 0.0, atol=1e-9)
force = -last.loc["z_low", "grain_force_z (N)"]
assert np.isclose(normal[floor].sum(), force, rtol=1e-5), (normal[floor].sum(), force)
print("read by VTK", vtk.vtkVersion().GetVTKVersion(), "and pandas", pd.__version__, names)
"#;

#[test]
#[ignore = "needs Python with `pip install vtk pandas`"]
fn vtk_and_pandas_read_contacts_layers_and_walls() {
    Budget::oracle(430_000).spend(400 * 8 * 8 * 16);
    let folder = Folder::new("python_beds");
    let kinds = [
        ("layers", "axis = \"z\"\nlayers = 4"),
        ("walls", ""),
        ("contact_means", ""),
        ("contacts", ""),
        ("loads", "average = true"),
    ];
    let records: String = kinds
        .iter()
        .map(|(kind, keys)| {
            format!(
                "[[records]]\nname = \"{kind}\"\nkind = \"{kind}\"\nevery_steps = 200\n{keys}\n"
            )
        })
        .collect();
    let bed = "[[grains]]\nkind = \"bed\"\ncount = 6\ndiameter = 1e-4\ndensity = 2650.0\nmotion = \"free\"\n";
    let rest = format!("{FLOOR_AND_LID}{GRAVITY}{bed}{records}[stop]\nsteps = 400\n");
    let scene = folder.write("scene.toml", water([8, 8, 16], 2.5e-5, &rest));
    let out = folder.path("out");
    let output = psmrt(&["run", scene.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    let output = Command::new("python3").args(["-c", PYTHON_OF_BEDS]).arg(&out).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("read by VTK"));
}
