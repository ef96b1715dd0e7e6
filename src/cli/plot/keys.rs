//! Keys that are pressed while a job runs.

use std::io::Read;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The keyboard. On Unix keys come at once and are not shown; elsewhere they come with Enter.
pub struct Keys {
    keys: Receiver<u8>,
    #[cfg(unix)]
    before: Option<rustix::termios::Termios>,
}

impl Keys {
    /// Begins to listen.
    pub fn listen() -> Self {
        #[cfg(unix)]
        let before = single_keys();
        let (sender, keys) = channel();
        std::thread::spawn(move || {
            for byte in std::io::stdin().lock().bytes() {
                let Ok(byte) = byte else { break };
                if sender.send(byte).is_err() {
                    break;
                }
            }
        });
        Self {
            keys,
            #[cfg(unix)]
            before,
        }
    }

    /// The next key, if one was pressed.
    pub fn pressed(&self) -> Option<u8> {
        self.keys.try_recv().ok()
    }

    /// The next key: `Ok(None)` where none was pressed, `Err` where none can come any more.
    pub fn poll(&self) -> Result<Option<u8>, ()> {
        match self.keys.try_recv() {
            Ok(key) => Ok(Some(key)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(()),
        }
    }
}

#[cfg(unix)]
impl Drop for Keys {
    fn drop(&mut self) {
        if let Some(before) = &self.before {
            let _ =
                rustix::termios::tcsetattr(std::io::stdin(), rustix::termios::OptionalActions::Now, before);
        }
    }
}

/// Has the terminal give keys one by one; what it was like before.
#[cfg(unix)]
fn single_keys() -> Option<rustix::termios::Termios> {
    use rustix::termios::{LocalModes, OptionalActions, tcgetattr, tcsetattr};
    let before = tcgetattr(std::io::stdin()).ok()?;
    let mut single = before.clone();
    single.local_modes.remove(LocalModes::ICANON | LocalModes::ECHO);
    tcsetattr(std::io::stdin(), OptionalActions::Now, &single).ok()?;
    Some(before)
}
