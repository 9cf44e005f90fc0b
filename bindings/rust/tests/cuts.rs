// SPDX-License-Identifier: Apache-2.0
use incise::{sys, Engine};

#[test]
fn cuts_and_takes_back() {
    let mut engine = Engine::new_box([0.0; 3], [1.0; 3], [4; 3]).unwrap();
    let before = engine.hash().unwrap();
    assert_eq!(engine.tets().unwrap().len(), 384);
    let report = engine.cut_plane([1.0, 0.1, 0.0], 0.51).unwrap();
    assert!(report.cut_tets > 0 && report.stroke == 1);
    assert_ne!(engine.hash().unwrap(), before);
    assert!(engine.undo().unwrap());
    assert_eq!(engine.hash().unwrap(), before);
}

#[test]
fn cuts_step_by_step() {
    let mut engine = Engine::new_box([0.0; 3], [1.0; 3], [4; 3]).unwrap();
    let blade = |z: f64| [[0.47, -0.2, z], [0.47, 1.2, z]];
    engine.begin_stroke(&blade(1.1)).unwrap();
    for i in 1..=10 {
        engine.step(&blade(1.1 - 0.13 * f64::from(i))).unwrap();
    }
    assert!(engine.end_stroke().unwrap().cut_tets > 0);
    let live = engine.tets().unwrap().iter().filter(|tet| tet[0] != sys::INCISE_NONE).count();
    assert_eq!(live as u64, engine.counts().unwrap().tets);
}

#[test]
fn errors_carry_ids() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let error = Engine::new(&points, &[[0, 1, 2, 3], [0, 2, 1, 3]], &Engine::default_options()).unwrap_err();
    assert_eq!(error.code, sys::INCISE_BAD_ARGUMENT);
    assert_eq!(error.ids, [1]);
}

#[test]
fn engines_go_to_other_threads() {
    let engine = Engine::new_box([0.0; 3], [1.0; 3], [2; 3]).unwrap();
    let hash = engine.hash().unwrap();
    assert_eq!(std::thread::spawn(move || engine.hash().unwrap()).join().unwrap(), hash);
}
