//! Text files, line by line, for parsers that do not tell where they stopped.

use super::excerpt;
use std::cell::Cell;
use std::io::{self, Read, Seek, SeekFrom};

/// The lines of a text with their numbers from 1. A line that ends in `\` goes on in the next one.
#[derive(Debug, Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

/// One line: its number, and its parts, of which there are several where it goes on.
#[derive(Debug, Clone)]
pub(super) struct Line<'a> {
    pub number: usize,
    pub first: &'a [u8],
    pub more: Vec<&'a [u8]>,
}

impl<'a> Lines<'a> {
    pub fn new(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0 }
    }

    /// The next line as it stands; `\n`, `\r\n` and `\r` end lines.
    fn raw(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let end = end.unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        let step = if self.rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.rest = self.rest.get(end + step..).unwrap_or_default();
        Some(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let mut part = self.raw()?;
        let mut line =
            Line { number: self.number, first: part.strip_suffix(b"\\").unwrap_or(part), more: Vec::new() };
        while part.ends_with(b"\\")
            && let Some(next) = self.raw()
        {
            part = next;
            line.more.push(part.strip_suffix(b"\\").unwrap_or(part));
        }
        Some(line)
    }
}

impl<'a> Line<'a> {
    /// The words, up to a comment that begins with `#`.
    pub fn words(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        std::iter::once(self.first)
            .chain(self.more.iter().copied())
            .flat_map(|part| part.split(|b| b.is_ascii_whitespace()))
            .filter(|word| !word.is_empty())
            .take_while(|word| !word.starts_with(b"#"))
    }

    /// The line in quotes, for error messages.
    pub fn excerpt(&self) -> String {
        let words: Vec<&[u8]> = self.words().collect();
        excerpt(&words.join(&b' '))
    }
}

/// A number as C's `strtod` writes it.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Text for a parser: a header, the rewritten lines, a footer. Gives at most one line per call of
/// `read`, so that `line` is always the number of the line that the parser works on.
pub(super) struct Feed<'a> {
    header: &'static [u8],
    text: &'a [u8],
    footer: &'static [u8],
    rewrite: fn(&Line, &mut Vec<u8>),
    line: &'a Cell<usize>,
    lines: Lines<'a>,
    is_footer_given: bool,
    chunk: Vec<u8>,
    at: usize,
}

impl<'a> Feed<'a> {
    /// `rewrite` appends what the parser shall see of a line, with its line end; nothing to hide
    /// the line.
    pub fn new(
        [header, footer]: [&'static [u8]; 2],
        text: &'a [u8],
        rewrite: fn(&Line, &mut Vec<u8>),
        line: &'a Cell<usize>,
    ) -> Self {
        Self {
            header,
            text,
            footer,
            rewrite,
            line,
            lines: Lines::new(text),
            is_footer_given: false,
            chunk: header.to_vec(),
            at: 0,
        }
    }

    fn refill(&mut self) {
        self.chunk.clear();
        self.at = 0;
        while self.chunk.is_empty() {
            if let Some(line) = self.lines.next() {
                self.line.set(line.number);
                (self.rewrite)(&line, &mut self.chunk);
            } else {
                if !self.is_footer_given {
                    self.chunk.extend_from_slice(self.footer);
                }
                self.is_footer_given = true;
                return;
            }
        }
    }
}

impl Read for Feed<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.at == self.chunk.len() {
            self.refill();
        }
        let n = out.len().min(self.chunk.len() - self.at);
        out[..n].copy_from_slice(&self.chunk[self.at..self.at + n]);
        self.at += n;
        Ok(n)
    }
}

impl Seek for Feed<'_> {
    /// Goes to the start; other places are not supported.
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        if to != SeekFrom::Start(0) {
            return Err(io::ErrorKind::Unsupported.into());
        }
        *self = Feed::new([self.header, self.footer], self.text, self.rewrite, self.line);
        Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_three_ways_and_go_on() {
        let lines: Vec<Line> = Lines::new(b"a b\r\nc \\\nd#\n\re # f g\n").collect();
        let words = |i: usize| lines[i].words().collect::<Vec<_>>();
        assert_eq!(words(0), [b"a", b"b"]);
        assert_eq!(words(1), [&b"c"[..], b"d#"]);
        assert_eq!(lines[1].number, 2);
        assert!(words(2).is_empty());
        assert_eq!((lines[3].number, words(3)), (5, vec![&b"e"[..]]));
    }

    #[test]
    fn the_feed_gives_a_line_at_a_time() {
        let line = Cell::new(0);
        let rewrite = |line: &Line, out: &mut Vec<u8>| {
            if line.first != b"hide" {
                out.extend_from_slice(line.first);
                out.push(b'\n');
            }
        };
        let mut feed = Feed::new([b"head\n", b"foot\n"], b"one\nhide\ntwo", rewrite, &line);
        let mut buffer = [0; 64];
        let mut seen = Vec::new();
        loop {
            let n = feed.read(&mut buffer).unwrap();
            if n == 0 {
                break;
            }
            seen.push((line.get(), buffer[..n].to_vec()));
        }
        let expected = [(0, "head\n"), (1, "one\n"), (3, "two\n"), (3, "foot\n")];
        assert_eq!(seen, expected.map(|(n, text)| (n, text.as_bytes().to_vec())));
    }
}
