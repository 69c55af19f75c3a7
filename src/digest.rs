//! What identifies data: SHA-256 of numbers bit by bit and of texts with their lengths, so that no two sequences run together.

use std::fmt::{self, Write};
use std::io::{self, Read};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// 256 bits that stand for what was hashed; 64 hexadecimal digits as text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Key([u8; 32]);

impl Key {
    /// SHA-256 of bytes alone, as `sha256sum` prints it.
    pub fn of_bytes(bytes: &[u8]) -> Key {
        Key(Sha256::digest(bytes).into())
    }

    /// As [`Key::of_bytes`], of bytes that need not fit into memory.
    ///
    /// # Errors
    /// What the reader says.
    pub fn of_reader(bytes: &mut impl Read) -> io::Result<Key> {
        let mut digest = Sha256::new();
        let mut some = vec![0; 1 << 16];
        loop {
            match bytes.read(&mut some) {
                Ok(0) => return Ok(Key(digest.finalize().into())),
                Ok(count) => digest.update(&some[..count]),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl From<Key> for String {
    fn from(key: Key) -> String {
        key.to_string()
    }
}

impl TryFrom<String> for Key {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Key, Self::Error> {
        text.parse()
    }
}

impl FromStr for Key {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Key, Self::Err> {
        let mut key = [0; 32];
        let digits = text.as_bytes();
        if digits.len() != 64 || !digits.iter().all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f')) {
            return Err("a key has 64 hexadecimal digits");
        }
        for (byte, pair) in key.iter_mut().zip(digits.as_chunks::<2>().0) {
            *byte = pair.iter().fold(0, |byte, digit| 16 * byte + (*digit as char).to_digit(16).unwrap_or(0) as u8);
        }
        Ok(Key(key))
    }
}

/// A key in the making.
#[derive(Clone)]
pub(crate) struct Digest(Sha256);

impl Digest {
    /// Of data of this kind; the same data of another kind has another key.
    pub fn of(kind: &str) -> Digest {
        Digest(Sha256::new()).text(kind)
    }

    pub fn text(mut self, text: &str) -> Digest {
        self = self.count(text.len());
        self.0.update(text);
        self
    }

    pub fn count(mut self, count: usize) -> Digest {
        self.0.update((count as u64).to_le_bytes());
        self
    }

    pub fn counts(self, counts: impl IntoIterator<Item = usize>) -> Digest {
        let (digest, found) = counts.into_iter().fold((self, 0), |(digest, found), n| (digest.count(n), found + 1));
        digest.count(found)
    }

    pub fn number(mut self, number: f64) -> Digest {
        self.0.update(number.to_bits().to_le_bytes());
        self
    }

    pub fn numbers(self, numbers: impl IntoIterator<Item = f64>) -> Digest {
        let (digest, found) = numbers.into_iter().fold((self, 0), |(digest, found), x| (digest.number(x), found + 1));
        digest.count(found)
    }

    pub fn perhaps(self, number: Option<f64>) -> Digest {
        self.numbers(number)
    }

    pub fn key(mut self, key: Key) -> Digest {
        self.0.update(key.0);
        self
    }

    /// A value as its derived `Debug` writes it: every field by name, and numbers with all their digits. For what may be
    /// made anew when a name changes.
    pub fn shown(mut self, value: &impl fmt::Debug) -> Digest {
        // Hashing never fails.
        let _ = write!(Hashed(&mut self.0), "{value:?}");
        self.count(0)
    }

    pub fn finish(self) -> Key {
        Key(self.0.finalize().into())
    }
}

struct Hashed<'a>(&'a mut Sha256);

impl Write for Hashed<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text);
        Ok(())
    }
}
