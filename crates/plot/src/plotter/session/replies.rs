//! What comes from the machine: XON, XOFF, and lines that end with a carriage return or ETX.

const XON: u8 = 17;
const XOFF: u8 = 19;
/// Longer lines are noise.
const LONGEST_LINE: usize = 160;

/// One thing that the machine said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Reply {
    Go,
    Stop,
    Line(String),
}

/// Takes replies apart that come in any pieces.
#[derive(Debug, Clone, Default)]
pub(super) struct Replies {
    line: Vec<u8>,
}

impl Replies {
    pub(super) fn read(&mut self, bytes: &[u8]) -> Vec<Reply> {
        let mut out = Vec::new();
        for &byte in bytes {
            match byte {
                XON => out.push(Reply::Go),
                XOFF => out.push(Reply::Stop),
                // GP-GL ends its answers with ETX.
                b'\r' | b'\n' | 0x03 => {
                    let line = std::mem::take(&mut self.line);
                    if !line.is_empty() {
                        out.push(Reply::Line(String::from_utf8_lossy(&line).into_owned()));
                    }
                }
                _ if self.line.len() < LONGEST_LINE => self.line.push(byte),
                _ => {}
            }
        }
        out
    }

    /// Forgets what was left unfinished.
    pub(super) fn clear(&mut self) {
        self.line.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_signs_in_any_pieces() {
        let mut replies = Replies::default();
        assert_eq!(replies.read(b"10"), []);
        let line = |text: &str| Reply::Line(text.to_owned());
        assert_eq!(replies.read(b"\x1324\r\n\x11"), [Reply::Stop, line("1024"), Reply::Go]);
        assert_eq!(replies.read(&[b'x'; 500]), []);
        assert_eq!(replies.read(b"\r"), [line(&"x".repeat(LONGEST_LINE))]);
    }
}
