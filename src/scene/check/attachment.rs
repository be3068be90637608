//! Files that a scene names: a run keeps a copy of each.

use std::sync::Arc;

/// The contents of a file that a scene names.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// The key that names it.
    pub key: String,
    /// Name of the copy in the folder of a run.
    pub file_name: String,
    /// What is in it: an image has the same bytes in hand.
    pub bytes: Arc<Vec<u8>>,
    /// Columns of it that nobody uses, since its grains are not free: "densities", "velocities".
    pub unused: Vec<&'static str>,
}

impl Attachment {
    /// The list of the `[[grains]]` section of this number.
    pub(super) fn of_grains(section: usize, bytes: Vec<u8>, unused: Vec<&'static str>) -> Self {
        let ending = if super::vtk_file::is_vtk(&bytes) { "vtp" } else { "csv" };
        let file_name = format!("grains_{section}.{ending}");
        let key = format!("grains[{section}].file");
        Attachment { key, file_name, bytes: Arc::new(bytes), unused }
    }

    /// A field that `key` names.
    pub(super) fn of_field(key: &str, file_name: &str, bytes: Vec<u8>) -> Self {
        Self::of_shared(key, file_name, Arc::new(bytes))
    }

    /// Bytes that are in use elsewhere too.
    pub(super) fn of_shared(key: &str, file_name: &str, bytes: Arc<Vec<u8>>) -> Self {
        let (key, file_name) = (key.to_owned(), file_name.to_owned());
        Attachment { key, file_name, bytes, unused: Vec::new() }
    }

    /// Values in time that the key names: `faces.z_low.pressure.file` becomes `faces_z_low_pressure.csv`.
    pub(super) fn of_values(key: &str, bytes: Vec<u8>) -> Self {
        let stem = key.trim_end_matches(".file").replace(']', "").replace(['.', '['], "_");
        let file_name = format!("{stem}.csv");
        Self::of_shared(key, &file_name, Arc::new(bytes))
    }
}
