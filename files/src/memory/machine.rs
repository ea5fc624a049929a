//! Finds how much memory the system would give this process.
//!
//! On Linux the kernel reports three numbers in files, of which the least counts. The first is the
//! free memory of the machine (`/proc/meminfo`). The second is the rest of the limits of the
//! process's control groups (version 1 and 2, all levels). The third is the rest of the limit of
//! its address space (`ulimit -v`). On other systems the memory is unknown.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the bytes that the process can take now, if the system reports them.
pub(super) fn free() -> Option<u64> {
    let machine = fs::read_to_string("/proc/meminfo").ok().and_then(|text| available(&text));
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    let groups = group_folders(&groups).into_iter().filter_map(|folder| left_in_group(&folder));
    machine.into_iter().chain(groups).chain(address_space()).min()
}

/// Returns the bytes of address space that the process can still take, if the address space is
/// limited.
pub(super) fn address_space() -> Option<u64> {
    let limit = limit(&fs::read_to_string("/proc/self/limits").ok()?)?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    Some(limit.saturating_sub(kilobytes(&status, "VmSize:")?))
}

/// Returns `MemAvailable` of `/proc/meminfo`, in bytes: memory that can be taken without swapping.
fn available(meminfo: &str) -> Option<u64> {
    kilobytes(meminfo, "MemAvailable:")
}

/// Returns the number of kB after `word` at the start of a line, in bytes.
fn kilobytes(text: &str, word: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(word))?;
    line.split_whitespace().next()?.parse::<u64>().ok()?.checked_mul(1024)
}

/// Returns the soft limit of the address space in `/proc/self/limits`, in bytes.
fn limit(limits: &str) -> Option<u64> {
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Returns the folders of the groups in `/proc/self/cgroup` that may limit memory, each with the
/// groups above it.
fn group_folders(cgroup: &str) -> Vec<PathBuf> {
    let mut folders = Vec::new();
    for line in cgroup.lines() {
        let mut fields = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else { continue };
        let root = match controllers {
            "" => Path::new("/sys/fs/cgroup"),
            _ if controllers.split(',').any(|name| name == "memory") => {
                Path::new("/sys/fs/cgroup/memory")
            }
            _ => continue,
        };
        let path = Path::new(path.trim_start_matches('/'));
        folders.extend(path.ancestors().map(|above| root.join(above)));
    }
    folders
}

/// Returns the bytes left of a group's limit, if the group has one. Cached pages of files that the
/// kernel can release count as free.
fn left_in_group(folder: &Path) -> Option<u64> {
    let number = |name: &str| fs::read_to_string(folder.join(name)).ok()?.trim().parse().ok();
    let (limit, used): (u64, u64) = match number("memory.max") {
        Some(limit) => (limit, number("memory.current")?),
        None => (number("memory.limit_in_bytes")?, number("memory.usage_in_bytes")?),
    };
    let stat = fs::read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let idle = ["total_inactive_file ", "inactive_file "].into_iter().find_map(|word| {
        stat.lines().find_map(|line| line.strip_prefix(word))?.trim().parse::<u64>().ok()
    });
    Some(limit.saturating_sub(used.saturating_sub(idle.unwrap_or(0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_memory_is_what_the_kernel_calls_available() {
        let text = "MemTotal:       24684492 kB\nMemFree: 3 kB\nMemAvailable:   24045816 kB\n";
        assert_eq!(available(text), Some(24_045_816 << 10));
        assert_eq!(available("MemTotal: 1 kB\n"), None);
    }

    #[test]
    fn an_address_space_without_a_limit_is_none() {
        let limits = |soft: &str| {
            format!(
                "Max data size  5  6  bytes\nMax address space         {soft}            unlimited            bytes     \n"
            )
        };
        assert_eq!(limit(&limits("unlimited")), None);
        assert_eq!(limit(&limits("2048000000")), Some(2_048_000_000));
    }

    #[test]
    fn a_group_is_limited_by_those_above_it() {
        let folders = group_folders("4:memory,hugetlb:/a\n3:cpu:/b\n0::/user/app\n");
        let expected = ["memory/a", "memory", "user/app", "user", ""];
        assert_eq!(folders, expected.map(|name| Path::new("/sys/fs/cgroup").join(name)));
    }

    #[test]
    fn a_group_has_its_limit_less_what_it_holds_and_cannot_let_go() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        assert_eq!(left_in_group(folder.path()), None);
        write("memory.max", "max\n");
        write("memory.current", "700\n");
        assert_eq!(left_in_group(folder.path()), None);
        write("memory.max", "1000\n");
        assert_eq!(left_in_group(folder.path()), Some(300));
        write("memory.stat", "anon 400\ninactive_file 200\nactive_file 50\n");
        assert_eq!(left_in_group(folder.path()), Some(500));
    }
}
