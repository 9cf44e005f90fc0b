// SPDX-License-Identifier: Apache-2.0
//! Where libincise.so is: in $INCISE_LIB_DIR, else where the system looks.
fn main() {
    println!("cargo:rerun-if-env-changed=INCISE_LIB_DIR");
    if let Ok(folder) = std::env::var("INCISE_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
}
