/// Whoever waits for a sweep.
pub trait Watcher: Sync {
    /// So many cases of so many are done and on the disk.
    fn progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Whether the sweep shall stop; asked often, by all threads.
    fn interrupted(&self) -> bool {
        false
    }
}
