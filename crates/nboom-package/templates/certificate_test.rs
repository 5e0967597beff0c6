
#[test]
fn /*FUNCTION*/_is_as_certified() {
    let table = include_str!("/*NAME*/.csv");
    on_large_stack(|| compare::</*CRATE*/::/*NAME*/>("/*NAME*/", table, /*TOLERANCE*/, /*OFF*/));
}
