//! Prints `golden/conformance/confusion.csv`: each mistake planted in the NumPy candidate, and what the
//! judge names.
//!
//! ```sh
//! cargo run --example confusion > golden/conformance/confusion.csv
//! ```

#[path = "../tests/conformance/mod.rs"]
mod conformance;

fn main() {
    let folder = conformance::with_kit(&std::env::temp_dir(), "psmrt_confusion");
    let table = conformance::confusion(&folder);
    println!(
        "# Each mistake of the catalogue, planted in golden/conformance/numpy_candidate.py, and what the judge names."
    );
    println!("# Written by: cargo run --example confusion");
    print!("{table}");
    // Only temporary files are left behind if this fails.
    let _ = std::fs::remove_dir_all(&folder);
}
