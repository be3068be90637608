//! Prints `golden/conformance/confusion.csv`: each mistake planted in the NumPy candidate, and what the
//! judge names.
//!
//! ```sh
//! cargo run -p psmrt-validation --example confusion > golden/conformance/confusion.csv
//! cargo run -p psmrt-validation --example confusion f32 > golden/conformance/confusion_f32.csv
//! cargo run -p psmrt-validation --example confusion f16-storage > golden/conformance/confusion_f16.csv
//! ```

#[path = "../../conformance/mod.rs"]
mod conformance;

fn main() {
    let precision = std::env::args().nth(1).unwrap_or_else(|| "f64".to_owned());
    let folder = conformance::with_kit(&std::env::temp_dir(), "psmrt_confusion");
    let table = conformance::confusion(&folder, &precision);
    println!(
        "# Each mistake of the catalogue, planted in golden/conformance/numpy_candidate.py working in"
    );
    println!(
        "# {precision}, and what the judge names; no wrong answers: it is too small to be seen."
    );
    println!("# Written by: cargo run -p psmrt-validation --example confusion {precision}");
    print!("{table}");
    // Only temporary files are left behind if this fails.
    let _ = std::fs::remove_dir_all(&folder);
}
