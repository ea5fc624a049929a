//! triangulate
