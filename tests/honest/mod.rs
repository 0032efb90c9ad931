//! Nothing wrong without a word: what data cannot carry is withheld, what is odd is said, what is left
//! out is counted, and no input costs more than it should. Runs the program as a user does.

mod benches;
mod dropped;
mod ends;
mod file;
mod kinds;
mod matrix;
mod unrelated;
mod withheld;
