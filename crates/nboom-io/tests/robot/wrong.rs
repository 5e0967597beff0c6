//! What people are told about robots that are nearly right, whole messages.

use nboom_io::parse_robot;
use nboom_model::Base;

use super::support::told_of_wrong_files;

#[test]
fn nearly_right_robots_are_told_what_to_change() {
    told_of_wrong_files("robot/wrong", "urdf", 8, |text| {
        parse_robot("arm.urdf", text, "arm", Base::Free).expect_err("wrong").to_string()
    });
}
