//! Files of images: the same solid whatever the file, a copy of it in the folder of a run, and what is said of bad ones.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use psmrt::output::npy;
use psmrt::scene::Scene;
use psmrt_reference::solids::Solid;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::{Gray8, Gray16, RGB8};
use tiff::tags::Tag;

use crate::cli::{Folder, psmrt_in, stderr};
use crate::scenes::water;

const COUNTS: [usize; 3] = [5, 4, 3];

/// The numbers of the image of these tests: 300 where it is solid, else below 4; beyond a byte, so that none is lost.
fn number([x, y, z]: [usize; 3]) -> u16 {
    if (x * y + z) % 3 == 1 { 300 } else { u16::try_from((x + y + z) % 4).unwrap() }
}

/// All numbers, x fastest or z fastest.
fn numbers(x_fastest: bool) -> Vec<u16> {
    let [nx, ny, nz] = COUNTS;
    (0..nx * ny * nz)
        .map(|i| match x_fastest {
            true => number([i % nx, i / nx % ny, i / (nx * ny)]),
            false => number([i / (ny * nz), i / nz % ny, i % nz]),
        })
        .collect()
}

fn little(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// A NumPy array with a header of its own.
fn with_header(header: &str, values: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values);
    bytes
}

/// A TIFF file of the slices.
fn tiff(slices: impl Iterator<Item = usize>) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    for z in slices {
        let slice: Vec<u16> = (0..20).map(|i| number([i % 5, i / 5, z])).collect();
        encoder.write_image::<Gray16>(5, 4, &slice).unwrap();
    }
    file.into_inner()
}

/// Water with an image, with the keys of the image.
fn text(image: &str) -> String {
    water(
        [8, 8, 8],
        1e-5,
        &format!(
            "[[grains]]\nkind = \"voxels\"\nimage = {{ voxel = 1e-5, {image} }}\n[body_force]\n\
             acceleration = [0.0, 0.0, 0.1]\n[stop]\nsteps = 4\n"
        ),
    )
}

fn load(folder: &Folder, image: &str) -> Result<Scene, String> {
    Scene::from_bytes("scene.toml", text(image).into_bytes(), &folder.path(""), &[])
        .map_err(|error| error.to_string())
}

/// The solid that a scene's image is.
fn solid(scene: &Scene) -> Solid {
    let solids = &scene.setup.solid_phase.as_ref().unwrap().solids;
    assert_eq!(solids.len(), 1);
    solids[0].clone()
}

#[test]
fn the_same_image_in_any_file_is_the_same_solid() {
    let folder = Folder::new("image_files");
    let zyx = numbers(true);
    let big: Vec<u8> = zyx.iter().flat_map(|number| number.to_be_bytes()).collect();
    let mut after_header = b"header".to_vec();
    after_header.extend(little(&zyx));
    let mut plain = Vec::new();
    npy::array(&mut plain, &[3, 4, 5], zyx.iter().map(|&number| number.into())).unwrap();
    folder.write("plain.npy", plain);
    let of = |order: &str, shape: &str| {
        format!("{{'descr': '<u2', 'fortran_order': {order}, 'shape': {shape}, }}\n")
    };
    folder.write("u2.npy", with_header(&of("False", "(3, 4, 5)"), &little(&zyx)));
    folder.write("xyz.npy", with_header(&of("False", "(5, 4, 3)"), &little(&numbers(false))));
    // What runs fastest in C order of (z, y, x) runs fastest in Fortran order of (x, y, z).
    folder.write("fortran.npy", with_header(&of("True", "(5, 4, 3)"), &little(&zyx)));
    folder.write("little.raw", little(&zyx));
    folder.write("big.raw", big);
    folder.write("after.raw", after_header);
    folder.write("stack.TIF", tiff(0..3));
    fs::create_dir(folder.path("slices")).unwrap();
    for z in 0..3 {
        // 9, 10, 11: in the order of the numbers, not of the letters.
        folder.write(&format!("slices/s_{}.tif", z + 9), tiff(z..z + 1));
    }
    folder.write("slices/notes.txt", "not a slice");
    let raw = "shape = [5, 4, 3], numbers = \"u16\"";
    let expected = solid(&load(&folder, "file = \"plain.npy\", solid = [300]").unwrap());
    let volume = (0..60).filter(|i| number([i % 5, i / 5 % 4, i / 20]) == 300).count();
    assert_eq!(expected.volume(), volume as f64);
    for image in [
        "file = \"plain.npy\", solid_above = 128".to_owned(),
        "file = \"plain.npy\", grey = [10, 20]".to_owned(),
        "file = \"u2.npy\", solid = [300]".to_owned(),
        "file = \"xyz.npy\", axes = \"xyz\", solid = [300]".to_owned(),
        "file = \"fortran.npy\", axes = \"xyz\", solid = [300, 301]".to_owned(),
        format!("file = \"little.raw\", {raw}, solid = [300]"),
        format!("file = \"big.raw\", {raw}, byte_order = \"big\", solid = [300]"),
        format!("file = \"after.raw\", {raw}, header_bytes = 6, solid = [300]"),
        "file = \"stack.TIF\", solid = [300]".to_owned(),
        "file = \"slices\", solid = [300]".to_owned(),
    ] {
        let found =
            solid(&load(&folder, &image).unwrap_or_else(|error| panic!("{image}: {error}")));
        assert!(found == expected, "{image} is another solid");
    }
}

#[test]
fn the_domain_is_as_large_as_the_image_and_a_coarser_grid_keeps_its_volume() {
    let folder = Folder::new("image_domain");
    folder.write("stack.tif", tiff(0..3));
    let image = "file = \"stack.tif\", solid = [300], crop_from = [1, 0, 0], mirror = [\"z\"]";
    let text = text(image).replace("cells = [8, 8, 8]\n", "");
    let read = |text: &str| Scene::from_bytes("scene.toml", text.into(), &folder.path(""), &[]);
    let fine = read(&text).unwrap();
    assert_eq!(fine.setup.domain.cells(), [4, 4, 6]);
    let coarse = read(&text.replace("dx = 1e-5", "dx = 2e-5")).unwrap();
    assert_eq!(coarse.setup.domain.cells(), [2, 2, 3]);
    assert!((8.0 * solid(&coarse).volume() - solid(&fine).volume()).abs() < 1e-12);
    let error = read(&text.replace("dx = 1e-5", "dx = 3e-5")).unwrap_err().to_string();
    assert!(error.contains("no whole number of cells"), "{error}");
}

#[test]
fn a_run_keeps_the_image_and_goes_on_with_it() {
    let folder = Folder::new("image_resume");
    fs::create_dir(folder.path("slices")).unwrap();
    folder.write("slices/1.tif", tiff(0..3));
    folder.write("scene.toml", text("file = \"slices\", solid = [300]"));
    let run = |arguments: &[&str]| {
        let output = psmrt_in(&folder.path(""), arguments);
        assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    };
    run(&["run", "scene.toml", "--out", "whole", "--set", "checkpoint.at_end=true"]);
    run(&["run", "scene.toml", "--out", "half", "--set", "stop.steps=2"]);
    fs::remove_dir_all(folder.path("slices")).unwrap();
    run(&["resume", "half", "--set", "stop.steps=4", "--out", "on"]);
    let kept = fs::read(folder.path("on/grains_0.npy")).unwrap();
    assert_eq!(psmrt::npy::read(&kept).unwrap().0, [3, 4, 5]);
    let state = |name: &str| {
        let scene = Scene::load(&folder.path(name).join("scene.toml"), &[]).unwrap();
        solid(&scene)
    };
    assert!(state("whole") == state("on"), "the image of the resumed run is another solid");
}

#[test]
fn bad_images_are_told_with_the_key_and_a_way_out() {
    let folder = Folder::new("bad_images");
    folder.write("stack.tif", tiff(0..3));
    folder.write("little.raw", little(&numbers(true)));
    let flat = |shape: &[usize], value: f64| {
        let mut bytes = Vec::new();
        let count = shape.iter().product();
        npy::array(&mut bytes, shape, std::iter::repeat_n(value, count)).unwrap();
        bytes
    };
    folder.write("plane.npy", flat(&[4, 4], 1.0));
    folder.write("nothing.npy", flat(&[0, 4, 4], 1.0));
    folder.write("full.npy", flat(&[8, 8, 8], 1.0));
    folder.write("nan.npy", flat(&[4, 4, 4], f64::NAN));
    folder.write("short.npy", &flat(&[4, 4, 4], 1.0)[..300]);
    folder.write("text.npy", "0 1 1 0\n");
    let mut lid = Vec::new();
    let is_lid = |i: usize| f64::from(u8::from(i / 64 == 3));
    npy::array(&mut lid, &[8, 8, 8], (0..512).map(is_lid)).unwrap();
    folder.write("lid.npy", lid);
    let mut colours = Cursor::new(Vec::new());
    TiffEncoder::new(&mut colours).unwrap().write_image::<RGB8>(2, 2, &[0; 12]).unwrap();
    folder.write("colours.tif", colours.into_inner());
    let mut unlike = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut unlike).unwrap();
    encoder.write_image::<Gray8>(2, 2, &[0; 4]).unwrap();
    encoder.write_image::<Gray8>(3, 2, &[0; 6]).unwrap();
    folder.write("unlike.tif", unlike.into_inner());
    fs::create_dir(folder.path("empty")).unwrap();
    fs::create_dir(folder.path("gap")).unwrap();
    folder.write("gap/s_1.tif", tiff(0..1));
    folder.write("gap/s_3.tif", tiff(1..2));
    let mut bundle = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bundle).unwrap();
    let mut image = encoder.new_image::<Gray8>(2, 2).unwrap();
    image.encoder().write_tag(Tag::ImageDescription, "ImageJ=1.53t\nimages=16\n").unwrap();
    image.write_data(&[0; 4]).unwrap();
    folder.write("bundle.tif", bundle.into_inner());
    folder.write(
        "huge.npy",
        with_header(
            "{'descr': '|u1', 'fortran_order': False, 'shape': (0, 4294967296, 4294967296), }\n",
            &[],
        ),
    );
    let labels = "{'descr': '<u8', 'fortran_order': False, 'shape': (2, 1, 1), }\n";
    folder.write(
        "labels.npy",
        with_header(labels, &[9_007_199_254_740_993_u64.to_le_bytes(), [0; 8]].concat()),
    );
    let stack = "file = \"stack.tif\"";
    let raw = "file = \"little.raw\", solid = [300]";
    for (image, key, told) in [
        (
            "file = \"missing.npy\", solid = [1]".to_owned(),
            "file",
            "missing.npy: it cannot be read",
        ),
        (
            "file = \"missing.raw\", solid = [1]".to_owned(),
            "file",
            "missing.raw: it cannot be read",
        ),
        (
            "file = \"plane.npy\", solid = [1]".to_owned(),
            "file",
            "its shape is [4, 4]; an image has three axes",
        ),
        ("file = \"nothing.npy\", solid = [1]".to_owned(), "file", "it has no voxels"),
        ("file = \"short.npy\", solid = [1]".to_owned(), "file", "it ends early"),
        ("file = \"text.npy\", solid = [1]".to_owned(), "file", "it is no .npy file"),
        ("file = \"colours.tif\", solid = [1]".to_owned(), "file", "one grey number"),
        ("file = \"unlike.tif\", solid = [1]".to_owned(), "file", "slice 1 (from 0): it has 3 x 2"),
        (
            "file = \"empty\", solid = [1]".to_owned(),
            "file",
            "no .tif or .tiff file in this folder",
        ),
        (stack.to_owned(), "solid", "nothing says what is solid"),
        (format!("{stack}, solid = []"), "solid", "the list is empty"),
        (format!("{stack}, solid = [300], solid_above = 4"), "solid_above", "more than once"),
        (format!("{stack}, grey = [7, 7]"), "grey", "are the same"),
        (
            format!("{stack}, solid = [9]"),
            "",
            "no voxel of it is solid: its numbers are 0, 1, 2, 3, 300",
        ),
        ("file = \"full.npy\", solid = [1]".to_owned(), "", "no pore is left"),
        ("file = \"lid.npy\", solid = [1]".to_owned(), "", "no pore lets fluid through along z"),
        (
            "file = \"nan.npy\", grey = [0, 1]".to_owned(),
            "file",
            "voxel [0, 0, 0] (x, y, z from 0) is NaN",
        ),
        (format!("{stack}, solid = [300], voxel2 = 1"), "voxel2", "has no key `voxel2`"),
        (format!("{stack}, solid = 300"), "solid", "a list of numbers in brackets"),
        (format!("{stack}, solid = [\"1\"]"), "solid", "each of its entries is a number"),
        (
            format!("{stack}, solid = [300], axes = \"xyz\""),
            "axes",
            "the slices of a TIFF file follow z",
        ),
        (
            format!("{stack}, solid = [300], numbers = \"u8\""),
            "numbers",
            "this file says it itself",
        ),
        (
            format!("{stack}, solid = [300], crop_from = [5, 0, 0]"),
            "crop_from",
            "along x the image has 5 voxels, and the part from 5 to absent is none of it",
        ),
        (
            format!("{stack}, solid = [300], crop_to = [5, 4, 4]"),
            "crop_to",
            "along z the image has 3 voxels, and the part from absent to 4 is none of it",
        ),
        (format!("{stack}, solid = [300], corner = [4e-5, 0, 0]"), "", "out of the domain"),
        (raw.to_owned(), "shape", "bare numbers need it"),
        (format!("{raw}, shape = [5, 4, 3]"), "numbers", "bare numbers need it"),
        (format!("{raw}, shape = [5, 4, 3], numbers = \"u8\""), "file", "it has 120 bytes"),
        (format!("{raw}, shape = [5, 4, 0], numbers = \"u16\""), "shape", "at least 1"),
        (
            format!("{raw}, shape = [5, 4, 3], numbers = \"u16\", header_bytes = -1"),
            "header_bytes",
            "at least 0",
        ),
    ] {
        let said = load(&folder, &image).expect_err(&image);
        let dot = if key.is_empty() { "" } else { "." };
        let wanted = format!("grains[0].image{dot}{key}");
        assert!(
            said.starts_with(&wanted) || said.contains(&format!("error: {wanted}")),
            "{image}: no {wanted} in\n{said}"
        );
        assert!(said.contains(told), "{image}: no {told:?} in\n{said}");
        assert!(said.contains("help: "), "{image}: no remedy in\n{said}");
    }
}

#[test]
fn an_image_does_not_move_and_no_grain_moves_beside_it() {
    let folder = Folder::new("still_images");
    folder.write("stack.tif", tiff(0..3));
    let read = |text: String| {
        Scene::from_bytes("scene.toml", text.into(), Path::new(&folder.path("")), &[])
    };
    let image = text("file = \"stack.tif\", solid = [300]");
    for (more, key, told) in [
        ("motion = \"free\"\n", "grains[0].motion", "cannot move from there"),
        ("motion = \"prescribed\"\n", "grains[0].motion", "cannot move from there"),
        ("velocity = [1e-3, 0, 0]\n", "grains[0].velocity", "an image is fixed"),
        ("diameter = 1e-4\n", "grains[0].diameter", "an image says itself"),
        ("file = \"a.npy\"\n", "grains[0].file", "an image is named by `image.file`"),
        ("density = 2650.0\n", "grains[0].density", "grains that are free"),
        (
            "[[grains]]\nkind = \"sphere\"\ncentre = [4e-5, 4e-5, 6e-5]\ndiameter = 3e-5\nmotion = \"prescribed\"\n\
             velocity = [0, 0, 1e-3]\n",
            "grains[1].centre",
            "nothing keeps it out",
        ),
    ] {
        let said = read(image.replace("[body_force]", &format!("{more}[body_force]")))
            .expect_err(more)
            .to_string();
        assert!(
            said.contains(key) && said.contains(told),
            "{more}: no {key} or {told:?} in\n{said}"
        );
    }
}
