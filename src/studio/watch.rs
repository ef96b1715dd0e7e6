//! Tells when another program changes a file.

use super::worker::Wake;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

/// Time between two looks at the file; it is settled when two of them are alike.
const LOOK: Duration = Duration::from_millis(500);

/// Watches a file until it is dropped.
pub struct Watch {
    is_changed: Arc<AtomicBool>,
    is_over: Arc<AtomicBool>,
}

/// Length and time of a file.
type Mark = Option<(u64, SystemTime)>;

impl Watch {
    /// Begins to watch a file; `wake` is called when it has changed.
    pub fn new(path: &Path, wake: Wake) -> Self {
        let (is_changed, is_over) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let (path, changed, over) = (path.to_owned(), is_changed.clone(), is_over.clone());
        let first = mark(&path);
        std::thread::spawn(move || {
            let (mut known, mut last) = (first, first);
            while !over.load(Ordering::Relaxed) {
                std::thread::sleep(LOOK);
                let now = mark(&path);
                // Some programs remove the file before they write it again.
                if now.is_some() && now == last && now != known {
                    known = now;
                    changed.store(true, Ordering::Relaxed);
                    wake();
                }
                last = now;
            }
        });
        Self { is_changed, is_over }
    }

    /// Whether it has changed since the last question.
    pub fn is_changed(&self) -> bool {
        self.is_changed.swap(false, Ordering::Relaxed)
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

fn mark(path: &Path) -> Mark {
    let data = std::fs::metadata(path).ok()?;
    Some((data.len(), data.modified().ok()?))
}
