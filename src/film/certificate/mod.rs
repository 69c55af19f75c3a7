//! Whether a film is a regular homotopy, kept beside it as a certificate that others can check.
//!
//! `surfaces` reads the frames of a film, or files of one mesh that were made elsewhere. `certify` decides what happens between them
//! (`crate::homotopy`), and `record` is what is kept of that.

mod certify;
mod record;
mod surfaces;

pub(super) use certify::is_stale;
pub use certify::{certificate_of, certify, kept_certificate, write_certificate};
pub use record::{
    CERTIFICATE, CERTIFIER, Certificate, CertifiedEvent, CertifiedFrame, CertifiedPoints, CertifiedQuadruple,
    CertifiedRim, EventKind,
};
