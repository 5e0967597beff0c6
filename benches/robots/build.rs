//! A routine of each robot, with its numbers built in.

fn main() -> Result<(), nboom_build::BuildError> {
    for robot in ["ur5", "panda", "anymal", "go2"] {
        nboom_build::Config::new()
            .baked_scene(format!("../../tests/data/robots/{robot}.urdf"))
            .write(&format!("{robot}.rs"))?;
    }
    Ok(())
}
