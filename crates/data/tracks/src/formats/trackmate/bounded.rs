//! A reader that gives up where one element of XML is too long.

use std::cell::Cell;
use std::io::{self, BufRead, Read};
use std::rc::Rc;

/// A reader that ends with an error where one event takes more than the room that is left.
pub(super) struct Bounded<R> {
    pub(super) inner: R,
    pub(super) room: Rc<Cell<u64>>,
}

impl<R: BufRead> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let got = self.inner.read(buffer)?;
        self.room.set(self.room.get().saturating_sub(got as u64));
        Ok(got)
    }
}

impl<R: BufRead> BufRead for Bounded<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.room.get() == 0 {
            return Err(io::Error::from(io::ErrorKind::FileTooLarge));
        }
        self.inner.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.room.set(self.room.get().saturating_sub(amount as u64));
        self.inner.consume(amount);
    }
}
