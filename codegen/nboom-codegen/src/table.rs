use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::{CodegenError, Output, Request};

/// Code of a function `kernels` that lists the routines ready to run; equations are left out,
/// and there is no function where nothing is left.
///
/// # Errors
/// When the path of the scalar crate is not one.
pub fn table(requests: &[Request]) -> Result<TokenStream, CodegenError> {
    let listed: Vec<&Request> =
        requests.iter().filter(|request| request.output == Output::Accelerations).collect();
    let Some(first) = listed.first() else { return Ok(TokenStream::new()) };
    let scalar = first.scalar()?;
    let count = Literal::usize_unsuffixed(listed.len());
    let names = listed.iter().map(|request| format_ident!("{}", request.name));
    Ok(quote! {
        /// The routines, ready to run on this processor.
        #[allow(dead_code)]
        pub fn kernels() -> &'static [#scalar::Kernel] {
            static ALL: ::std::sync::OnceLock<[#scalar::Kernel; #count]> =
                ::std::sync::OnceLock::new();
            ALL.get_or_init(|| [#(#scalar::Kernel::of::<#names>()),*])
        }
    })
}
