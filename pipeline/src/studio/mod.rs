//! The studio: a page on a local address, on which curves are edited beside their picture.
//!
//! ```text
//!   page  --- edits, views --->  routes  --->  board (texts, view, revision)
//!    ^                                             |
//!    |                                             v
//!    +--- events, pictures ----------  worker, spec_check
//! ```
//!
//! The texts are edited here, so that all windows show the same state. A thread makes pictures of the newest state: a
//! draft at once, then the whole picture, then that of the requested error. Another thread checks the specs.
//!
//! | module | responsibility |
//! |---|---|
//! | [`folder`] | the only files that are read and written |
//! | [`edit`], [`history`], [`texts`] | changes of single values; undone steps; texts and their files |
//! | [`opened`], [`automatic`], [`source`] | a job with its scene and specs; the scene of a spec that has none; their files |
//! | [`view`], [`board`] | size, error and methods of the picture; the state that threads and windows share |
//! | [`mesh`], [`kept`], [`worker`], [`png`] | meshes; the scene that pictures share; the thread of pictures; their encoding |
//! | [`curves`], [`spec_check`], [`scene_check`] | curves as points; findings and measures |
//! | [`export`], [`upload`], [`start`] | files with their commands; pictures that are given; the start page |
//! | [`token`], [`guard`], [`routes`], [`assets`], [`server`] | the word in the address; refused requests; requests; files of the page; address and threads |
//!
//! Limits: a picture has at most 2048 pixels across. Files that a scene includes are read again only with the scene.

pub mod assets;
pub mod automatic;
pub mod board;
pub mod curves;
pub mod edit;
pub mod export;
pub mod folder;
pub mod guard;
pub mod history;
pub mod kept;
pub mod mesh;
pub mod opened;
pub mod png;
pub mod routes;
pub mod scene_check;
pub mod server;
pub mod source;
pub mod spec_check;
pub mod start;
pub mod texts;
pub mod token;
pub mod upload;
pub mod view;
pub mod worker;
