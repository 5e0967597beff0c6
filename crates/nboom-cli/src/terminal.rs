//! Output for a terminal: text, without control characters that came in a name.

use std::borrow::Cow;
use std::cell::RefCell;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::builder::styling::AnsiColor;
use nboom_model::steers;

use crate::CliError;

/// Writes to standard output. It is no error if the reader has left, as `head` does.
pub(crate) fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(shown(text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(CliError::Stdout(error)),
        _ => Ok(()),
    }
}

thread_local! {
    /// What was said in this thread, while somebody hears it.
    static HEARD: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

/// Does work, and returns beside its result the warnings and notes that would else go to standard error.
pub fn hear<T>(work: impl FnOnce() -> T) -> (T, Vec<String>) {
    HEARD.set(Some(Vec::new()));
    let done = work();
    (done, HEARD.take().unwrap_or_default())
}

/// Prints to standard error, with the colour of its kind on a terminal that wants some, unless somebody
/// [hears](hear) it. An error in that cannot be reported, and is ignored.
pub(crate) fn say(kind: &str, line: &str) {
    let heard = |said: &mut Option<Vec<String>>| said.as_mut().map(|said| said.push(line.into()));
    if HEARD.with_borrow_mut(heard).is_some() {
        return;
    }
    let colour = match kind {
        "error" => AnsiColor::Red,
        "warning" => AnsiColor::Yellow,
        _ => AnsiColor::Cyan,
    };
    let style = colour.on_default().bold();
    let _ = writeln!(anstream::stderr(), "{style}{kind}:{style:#} {}", shown(line));
}

/// Prints the error of the command line, or the help that it asks for, and ends.
pub fn refuse(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    match shown(&text) {
        // With the colours of a terminal.
        Cow::Borrowed(_) => error.exit(),
        Cow::Owned(text) => {
            let _ = write!(io::stderr(), "{text}");
            ExitCode::from(error.exit_code().clamp(0, 255) as u8)
        }
    }
}

/// Text with the characters that a terminal obeys, or hides, written as JSON escapes; line ends stay.
fn shown(text: &str) -> Cow<'_, str> {
    let is_order = |c: char| steers(c) && c != '\n';
    if !text.contains(is_order) {
        return Cow::Borrowed(text);
    }
    let escaped = |c: char| {
        if is_order(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() }
    };
    Cow::Owned(text.chars().map(escaped).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_heard_is_said_once() {
        assert_eq!(hear(|| say("warning", "a slip")), ((), vec!["a slip".to_owned()]));
        assert!(HEARD.take().is_none());
    }

    #[test]
    fn orders_are_shown_and_not_sent() {
        let plain = "Ø: 1 °, \u{65e5}\nand a line";
        assert!(matches!(shown(plain), Cow::Borrowed(text) if text == plain));
        assert_eq!(shown("a\u{1b}[2Jb\r\u{9b}1m\u{7f}"), "a\\u001b[2Jb\\u000d\\u009b1m\\u007f");
        assert_eq!(shown("exe\u{202e}lmn"), "exe\\u202elmn");
        assert_eq!(shown("wi\u{200b}ng"), "wi\\u200bng");
    }

    #[test]
    fn json_stays_json() {
        let value = serde_json::json!({ "id": "a\u{1b}\u{7f}\u{9b}\u{202e}\u{2066}b" });
        let text = format!("{value:#}\n");
        let read: serde_json::Value = serde_json::from_str(&shown(&text)).expect("JSON");
        assert_eq!(read, value);
    }
}
