//! What people are told about scenes that are nearly right, whole messages.

use nboom_io::{ReadOptions, parse_scene};

use super::support::told_of_wrong_files;

#[test]
fn nearly_right_scenes_are_told_what_to_change() {
    let options = ReadOptions::default();
    told_of_wrong_files("scene/wrong", "toml", 10, |text| {
        parse_scene("boom.toml", text, "boom", None, &options).expect_err("wrong").to_string()
    });
}
