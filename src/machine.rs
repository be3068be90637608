//! What this machine has.

mod available;
mod spent;

use std::path::Path;
use std::time::Duration;

pub use available::{Available, available};
pub use spent::{Beginning, Spent};

/// Main memory in bytes, where the system says so.
pub fn memory_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemTotal:"))?;
    let kib: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024)
}

/// The same in words.
pub fn memory_words() -> String {
    let gib = |bytes| format!("{:.1} GiB", bytes as f64 / (1_u64 << 30) as f64);
    memory_bytes().map_or_else(|| "unknown".to_owned(), gib)
}

/// Bytes that this user may still write where `folder` is, or will be, where the system says so.
pub fn free_bytes(folder: &Path) -> Option<u64> {
    let absolute = std::path::absolute(folder).ok()?;
    let there = absolute.ancestors().find(|ancestor| ancestor.exists())?;
    free_bytes_of(there)
}

#[cfg(unix)]
fn free_bytes_of(folder: &Path) -> Option<u64> {
    let found = rustix::fs::statvfs(folder).ok()?;
    found.f_bavail.checked_mul(found.f_frsize)
}

#[cfg(not(unix))]
fn free_bytes_of(_: &Path) -> Option<u64> {
    None
}

/// Name of the processor, where the system says so.
pub fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Processor time of all threads of this program so far, where the system says so. Unlike the time on the
/// clock it hardly depends on what else the machine does.
pub fn processor_time() -> Option<Duration> {
    let nanoseconds = |entry: std::io::Result<std::fs::DirEntry>| -> Option<u64> {
        let text = std::fs::read_to_string(entry.ok()?.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse().ok()
    };
    // A thread may end while it is looked at: its time is missing then.
    let all = std::fs::read_dir("/proc/self/task").ok()?.filter_map(nanoseconds);
    Some(Duration::from_nanos(all.sum()))
}

/// Threads that the engines may use.
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Name of this machine among others, where the system says so.
pub fn host() -> Option<String> {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let name = name.or_else(|| std::env::var("COMPUTERNAME").or(std::env::var("HOSTNAME")).ok())?;
    Some(name.trim().to_owned()).filter(|name| !name.is_empty())
}

/// The operating system, by the name that it gives itself where it does.
pub fn system() -> String {
    let own_name = || {
        let text = std::fs::read_to_string("/etc/os-release").ok()?;
        let name = text.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="))?;
        Some(name.trim_matches('"').to_owned())
    };
    own_name().unwrap_or_else(|| std::env::consts::OS.to_owned())
}
