//! What drivers print on their own while adapters are listed.
//!
//! Mesa's Vulkan layer that chooses a device asks the Wayland display which one that uses, and the
//! Wayland library prints an error where there is no session, as in containers and over ssh. Nothing is
//! wrong then: psmrt opens no window. Neither wgpu (which asks for the extensions of all displays) nor
//! Vulkan has a switch for it but environment variables, which a program cannot set for itself safely.

/// A line that means nothing to users of psmrt.
const NOISE: &str = "XDG_RUNTIME_DIR";

/// Does the work; of what it prints to stderr, directly as libraries do, the noise is left out.
#[cfg(target_os = "linux")]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    use std::path::Path;
    use std::sync::{Mutex, PoisonError};
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

    if std::env::var_os(NOISE).is_some_and(|folder| Path::new(&folder).is_absolute()) {
        return work();
    }
    let _held = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    // Where stderr cannot be kept aside, the noise is the smaller evil.
    let _aside = Aside::new().ok();
    work()
}

#[cfg(not(target_os = "linux"))]
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    work()
}

/// Stderr, kept aside in memory until this is dropped.
#[cfg(target_os = "linux")]
struct Aside {
    stderr: std::os::fd::OwnedFd,
    memory: std::fs::File,
}

#[cfg(target_os = "linux")]
impl Aside {
    fn new() -> std::io::Result<Self> {
        use rustix::fs::{MemfdFlags, memfd_create};
        let stderr = rustix::io::fcntl_dupfd_cloexec(std::io::stderr(), 3)?;
        let memory = std::fs::File::from(memfd_create("stderr", MemfdFlags::CLOEXEC)?);
        rustix::stdio::dup2_stderr(&memory)?;
        Ok(Aside { stderr, memory })
    }
}

#[cfg(target_os = "linux")]
impl Drop for Aside {
    fn drop(&mut self) {
        use std::io::{Read, Seek, Write};
        if rustix::stdio::dup2_stderr(&self.stderr).is_err() {
            return;
        }
        let mut said = Vec::new();
        let read = self.memory.rewind().and_then(|()| self.memory.read_to_end(&mut said));
        if read.is_ok() {
            for line in said.split_inclusive(|&byte| byte == b'\n') {
                if !String::from_utf8_lossy(line).contains(NOISE) {
                    // If stderr is gone there is nobody to tell.
                    let _ = std::io::stderr().write_all(line);
                }
            }
        }
    }
}
