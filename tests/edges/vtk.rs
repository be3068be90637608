//! Reads the numbers of files for ParaView back: arrays appended raw, each after its length in bytes.

/// Every floating-point number of a file is finite.
pub fn assert_finite(bytes: &[u8], name: &str) {
    const START: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
    let found = bytes.windows(START.len()).position(|window| window == START);
    let head_end = found.unwrap_or_else(|| panic!("{name} has no data"));
    let head = std::str::from_utf8(&bytes[..head_end]).unwrap();
    let data = &bytes[head_end + START.len()..];
    let eight = |at: usize| -> [u8; 8] { data[at..at + 8].try_into().unwrap() };
    let mut arrays = 0;
    for array in head.split("<DataArray ").skip(1) {
        let value = |key: &str| {
            let from = array.split(&format!("{key}=\"")).nth(1).unwrap();
            from.split('"').next().unwrap()
        };
        let at: usize = value("offset").parse().unwrap();
        let length = usize::try_from(u64::from_le_bytes(eight(at))).unwrap();
        let values = &data[at + 8..at + 8 + length];
        let finite = match value("type") {
            "Float32" => {
                let read = |four: &[u8]| f32::from_le_bytes(four.try_into().unwrap());
                values.chunks_exact(4).map(read).all(f32::is_finite)
            }
            "Float64" => {
                let read = |eight: &[u8]| f64::from_le_bytes(eight.try_into().unwrap());
                values.chunks_exact(8).map(read).all(f64::is_finite)
            }
            _ => continue,
        };
        assert!(finite, "{name}: array {} holds what is not finite", value("Name"));
        arrays += 1;
    }
    assert!(arrays > 0, "{name} has no array of numbers");
}
