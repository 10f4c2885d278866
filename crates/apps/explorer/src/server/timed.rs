//! A connection with a time by which it must be done.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// A stream whose reads and writes fail after a point in time, however slowly the other side goes on.
pub(crate) struct Timed<'s> {
    stream: &'s TcpStream,
    end: Instant,
}

impl<'s> Timed<'s> {
    /// This stream, for so long from now on.
    pub(crate) fn new(stream: &'s TcpStream, time: Duration) -> Self {
        Self { stream, end: Instant::now() + time }
    }

    /// Allows so much time from now on.
    pub(crate) fn within(&mut self, time: Duration) {
        self.end = Instant::now() + time;
    }

    /// The stream itself.
    pub(crate) fn stream(&self) -> &'s TcpStream {
        self.stream
    }

    fn left(&self) -> Result<Option<Duration>> {
        let left = self.end.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(Error::from(ErrorKind::TimedOut)) } else { Ok(Some(left)) }
    }
}

impl Read for Timed<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(bytes)
    }
}

impl Write for Timed<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        self.stream.flush()
    }
}
