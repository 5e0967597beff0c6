
#[test]
fn /*FUNCTION*/_is_as_certified() {
    let table = include_str!("/*NAME*/.csv");
    compare::</*CRATE*/::/*NAME*/>("/*NAME*/", table, /*TOLERANCE*/, /*OFF*/);
}
