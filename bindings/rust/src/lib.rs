// SPDX-License-Identifier: Apache-2.0
//! Incise for Rust, in the small: an engine whose views borrow it, so that no view outlives what it shows. What is not
//! here is in `sys`, call by call as in C.
pub mod sys;

use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

/// What failed: its code (`sys::INCISE_BAD_ARGUMENT` …), in words, and the ids of the elements concerned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    pub code: i32,
    pub message: String,
    pub ids: Vec<u64>,
}

impl std::fmt::Display for Error {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(&self.message)
    }
}
impl std::error::Error for Error {}

fn check(status: i32) -> Result<(), Error> {
    if status == sys::INCISE_OK {
        return Ok(());
    }
    let message = unsafe { CStr::from_ptr(sys::incise_last_error()) };
    let mut ids = vec![0; unsafe { sys::incise_last_error_ids(null_mut(), 0) } as usize];
    unsafe { sys::incise_last_error_ids(ids.as_mut_ptr(), ids.len() as u64) };
    Err(Error { code: status, message: message.to_string_lossy().into_owned(), ids })
}

macro_rules! zeroed {
    ($kind:ty) => {{
        // Plain numbers and pointers: all zero is a value.
        let mut value: $kind = unsafe { std::mem::zeroed() };
        value.size = std::mem::size_of::<$kind>() as u32;
        value
    }};
}

/// Owns a mesh and cuts it. It may go to another thread, and is for one at a time.
#[derive(Debug)]
pub struct Engine {
    handle: *mut sys::incise_engine,
}
unsafe impl Send for Engine {}

impl Engine {
    /// The default options, to change and hand in.
    pub fn default_options() -> sys::incise_engine_options {
        let mut options = zeroed!(sys::incise_engine_options);
        let size = options.size;
        unsafe { sys::incise_default_engine_options(&mut options, size) };
        options
    }

    /// Of points and tets, four numbers of points each.
    pub fn new(points: &[[f64; 3]], tets: &[[u32; 4]], options: &sys::incise_engine_options) -> Result<Self, Error> {
        let mut mesh = zeroed!(sys::incise_mesh_arrays);
        mesh.points = points.as_ptr().cast();
        mesh.n_points = points.len() as u64;
        mesh.tets = tets.as_ptr().cast();
        mesh.n_tets = tets.len() as u64;
        let mut handle = null_mut();
        check(unsafe { sys::incise_engine_create(&mesh, options, &mut handle) })?;
        Ok(Self { handle })
    }

    /// A box of six tets per cell.
    pub fn new_box(low: [f64; 3], high: [f64; 3], cells: [u32; 3]) -> Result<Self, Error> {
        let mut handle = null_mut();
        check(unsafe {
            sys::incise_engine_create_box(low.as_ptr(), high.as_ptr(), cells.as_ptr(), null(), &mut handle)
        })?;
        Ok(Self { handle })
    }

    /// A mesh file.
    pub fn read(path: &str) -> Result<Self, Error> {
        let path = CString::new(path).unwrap_or_default();
        let mut handle = null_mut();
        check(unsafe { sys::incise_engine_read(path.as_ptr(), null(), &mut handle) })?;
        Ok(Self { handle })
    }

    /// Cuts all that is there along normal · x = offset.
    pub fn cut_plane(&mut self, normal: [f64; 3], offset: f64) -> Result<sys::incise_report, Error> {
        let mut report = zeroed!(sys::incise_report);
        check(unsafe { sys::incise_engine_cut_plane(self.handle, normal.as_ptr(), offset, &mut report) })?;
        Ok(report)
    }

    /// Puts the blade in place; returns the stroke's number.
    pub fn begin_stroke(&mut self, edge: &[[f64; 3]]) -> Result<u32, Error> {
        let mut stroke = 0;
        check(unsafe {
            sys::incise_engine_begin_stroke(self.handle, edge.as_ptr().cast(), edge.len() as u64, null(), &mut stroke)
        })?;
        Ok(stroke)
    }

    /// Moves the blade on and cuts up to where it stands.
    pub fn step(&mut self, edge: &[[f64; 3]]) -> Result<sys::incise_report, Error> {
        let mut report = zeroed!(sys::incise_report);
        check(unsafe {
            sys::incise_engine_step(self.handle, edge.as_ptr().cast(), edge.len() as u64, null(), &mut report)
        })?;
        Ok(report)
    }

    /// Lifts the blade off.
    pub fn end_stroke(&mut self) -> Result<sys::incise_report, Error> {
        let mut report = zeroed!(sys::incise_report);
        check(unsafe { sys::incise_engine_end_stroke(self.handle, &mut report) })?;
        Ok(report)
    }

    /// Takes the last stroke back; false where there is none.
    pub fn undo(&mut self) -> Result<bool, Error> {
        let mut done = 0;
        check(unsafe { sys::incise_engine_undo(self.handle, &mut done) })?;
        Ok(done != 0)
    }

    pub fn counts(&self) -> Result<sys::incise_counts, Error> {
        let mut counts = zeroed!(sys::incise_counts);
        check(unsafe { sys::incise_engine_counts(self.handle, &mut counts) })?;
        Ok(counts)
    }

    /// Of the mesh; the same on every machine.
    pub fn hash(&self) -> Result<u64, Error> {
        let mut hash = 0;
        check(unsafe { sys::incise_engine_hash(self.handle, &mut hash) })?;
        Ok(hash)
    }

    /// Tets by slot, without a copy; the first vertex of a free one is `sys::INCISE_NONE`.
    pub fn tets(&self) -> Result<&[[u32; 4]], Error> {
        self.view(sys::INCISE_TETS)
    }
    /// Places at rest by slot, without a copy.
    pub fn rest(&self) -> Result<&[[f64; 3]], Error> {
        self.view(sys::INCISE_REST)
    }

    fn view<T>(&self, which: i32) -> Result<&[T], Error> {
        let mut view = zeroed!(sys::incise_view);
        check(unsafe { sys::incise_engine_view(self.handle, which, &mut view) })?;
        if view.rows == 0 {
            return Ok(&[]);
        }
        assert_eq!(view.stride as usize, std::mem::size_of::<T>());
        // What changes the engine takes it as `&mut`, so nothing does while this is borrowed.
        Ok(unsafe { std::slice::from_raw_parts(view.data.cast(), view.rows as usize) })
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        unsafe { sys::incise_engine_free(self.handle) };
    }
}

/// The library's version.
pub fn version() -> String {
    unsafe { CStr::from_ptr(sys::incise_version()) }.to_string_lossy().into_owned()
}
