//! Memory that this process can still have: the least of what the machine, its control groups and its own
//! limits leave. Known on Linux; elsewhere nothing is said.

use std::fs;
use std::path::{Path, PathBuf};

/// What is left, and who sets the limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Available {
    /// Bytes.
    pub bytes: u64,
    /// Who sets the limit.
    pub limit: String,
}

/// Addresses that the C library's allocator (glibc) reserves for each thread when that first asks for memory.
const ARENA: u64 = 64 << 20;

/// Memory that this process can still have.
pub fn available() -> Option<Available> {
    let text = |path: &str| fs::read_to_string(path).ok();
    let mut all = Vec::new();
    let mut add = |bytes: Option<u64>, limit: &str| {
        all.extend(bytes.map(|bytes| Available { bytes, limit: limit.to_owned() }));
    };
    add(text("/proc/meminfo").and_then(|text| kib(&text, "MemAvailable:")), "free on this machine");
    if let (Some(limits), Some(status)) = (text("/proc/self/limits"), text("/proc/self/status")) {
        let arenas = ARENA * super::threads() as u64;
        for (name, used, reserved, words) in [
            ("Max address space", "VmSize:", arenas, "limit of the address space, ulimit -v"),
            ("Max data size", "VmData:", 0, "limit of the data, ulimit -d"),
        ] {
            let left = soft_limit(&limits, name)
                .and_then(|limit| Some(limit.saturating_sub(kib(&status, used)? + reserved)));
            add(left, words);
        }
    }
    if let Some(groups) = text("/proc/self/cgroup") {
        add(
            of_groups(Path::new("/sys/fs/cgroup"), &groups),
            "limit of the control group (container)",
        );
    }
    all.into_iter().min_by_key(|available| available.bytes)
}

/// The value of a line `name   123 kB`, in bytes.
fn kib(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find(|line| line.starts_with(name))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok()?.checked_mul(1024)
}

/// The soft limit of a line of `/proc/self/limits`; `None` where there is none.
fn soft_limit(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

/// What the control groups leave that `/proc/self/cgroup` names: those of version 2 below `root`, of version 1
/// below `root/memory`. The groups above count too, and where a container shows only its own as the root, that.
fn of_groups(root: &Path, groups: &str) -> Option<u64> {
    let left = |line: &str| -> Option<u64> {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next()?, parts.next()?);
        let (root, files) = if controllers.is_empty() {
            (root.to_owned(), ["memory.max", "memory.current", "inactive_file"])
        } else if controllers.split(',').any(|name| name == "memory") {
            let names = ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"];
            (root.join("memory"), names)
        } else {
            return None;
        };
        let mut folder: PathBuf = root.join(path.trim_start_matches('/'));
        let mut least = None;
        loop {
            least = least.into_iter().chain(of_group(&folder, files)).min();
            if folder == root || !folder.pop() {
                return least;
            }
        }
    };
    groups.lines().filter_map(left).min()
}

/// What one control group leaves: limit less use, where files in the cache that nobody reads give way.
fn of_group(folder: &Path, [limit, used, cache]: [&str; 3]) -> Option<u64> {
    let number = |name: &str| -> Option<u64> {
        fs::read_to_string(folder.join(name)).ok()?.trim().parse().ok()
    };
    let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let gives_way = stat.lines().find_map(|line| line.strip_prefix(cache)?.trim().parse().ok());
    Some(number(limit)?.saturating_sub(number(used)?.saturating_sub(gives_way.unwrap_or(0))))
}

#[cfg(test)]
mod tests {
    use super::{kib, of_groups, soft_limit};
    use std::fs;

    #[test]
    fn limits_are_read_as_the_kernel_writes_them() {
        let limits = "Limit                     Soft Limit           Hard Limit           Units     \n\
                      Max data size             unlimited            unlimited            bytes     \n\
                      Max address space         104857600            unlimited            bytes     \n";
        assert_eq!(soft_limit(limits, "Max address space"), Some(104_857_600));
        assert_eq!(soft_limit(limits, "Max data size"), None);
        let text = "MemTotal:       16 kB\nMemAvailable:   12 kB\n";
        assert_eq!(kib(text, "MemAvailable:"), Some(12 * 1024));
    }

    #[test]
    fn the_tightest_of_the_nested_control_groups_counts_and_the_cache_gives_way() {
        let root = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        write("a/memory.max", "1000\n");
        write("a/memory.current", "600\n");
        write("a/memory.stat", "anon 1\ninactive_file 100\n");
        write("a/b/memory.max", "max\n");
        write("a/b/memory.current", "500\n");
        assert_eq!(of_groups(root.path(), "0::/a/b\n"), Some(500));
        write("memory/c/memory.limit_in_bytes", "700\n");
        write("memory/c/memory.usage_in_bytes", "300\n");
        let both = "4:cpu,memory:/c\n0::/a/b\n";
        assert_eq!(of_groups(root.path(), both), Some(400));
        assert_eq!(of_groups(root.path(), "0::/nowhere\n"), None);
    }
}
