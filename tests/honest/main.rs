//! Nothing wrong without a word: what data cannot carry is withheld, what is odd is said, what is left
//! out is counted, and no input costs more than it should. Runs the program as a user does.

#[path = "../bench_of_files/mod.rs"]
#[allow(dead_code)]
mod bench_of_files;
mod benches;
mod dropped;
mod ends;
mod file;
mod kinds;
mod matrix;
#[path = "../milling_bench/mod.rs"]
mod milling_bench;
mod unrelated;
mod withheld;
