fn main() {
    let t = std::time::Instant::now();
    let r = nboom_io::read_scene(std::path::Path::new(&std::env::args().nth(1).unwrap()));
    let s = match r { Ok(f) => { for w in &f.warnings { println!("{w}"); } "ok".into() } Err(e) => e.to_string() };
    println!("{} ... {:?}", s.chars().take(300).collect::<String>(), t.elapsed());
    for l in std::fs::read_to_string("/proc/self/status").unwrap().lines().filter(|l| l.starts_with("VmHWM")) { println!("{l}"); }
}
