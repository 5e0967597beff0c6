//! A routine whose sweeps are loops over links, and over equal appendages side by side.

use nboom_expr::{Expr, Operations};
use nboom_formulation::Layout;
use nboom_formulation::stages::{
    self, AT_ORIGIN, ELIMINATED, Group, PADDLE, REACHED, SHOWN, Stage, TURNED,
};
use nboom_model::Shape;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::driver::{Call, Driver};
use crate::item::{Item, Signature};
use crate::stage::{Masks, Traced};
use crate::sweeps::{Whose, chain_sweeps, gather_constants, names, paddle_sweeps};
use crate::{Generated, Request};

/// Code for the request.
pub(crate) fn generate(request: &Request) -> Generated {
    let mut routine = Rolled::default();
    let mut parameter = Layout::MAIN;
    let mut hinge = 0;
    for (number, (shape, count)) in request.topology.groups().into_iter().enumerate() {
        let group = Equal { number, shape, count, parameter, hinge };
        routine.add_group(request, &group);
        parameter += count * group.parameters();
        hinge += count * shape.hinges();
    }
    routine.finish(request)
}

/// Equal appendages.
pub(crate) struct Equal {
    pub number: usize,
    pub shape: Shape,
    pub count: usize,
    /// Where the parameters of the first one begin.
    pub parameter: usize,
    /// Hinges before.
    pub hinge: usize,
}

impl Equal {
    pub fn parameters(&self) -> usize {
        Layout::BRANCH + Layout::LINK * self.shape.hinges()
    }

    pub fn prefix(&self) -> String {
        format!("g{}", self.number)
    }

    /// What is taken for granted of every appendage: `size` numbers from `offset` on, and of
    /// every one of `repeats` repetitions `stride` apart.
    fn pinned(
        &self,
        request: &Request,
        offset: usize,
        size: usize,
        repeats: usize,
    ) -> Vec<Option<f64>> {
        let at = |appendage: usize, repeat: usize, i: usize| {
            let start = self.parameter + appendage * self.parameters() + offset;
            request.pinned[start + repeat * Layout::LINK + i]
        };
        let common = |i: usize| {
            let first = at(0, 0, i);
            let same = |appendage| (0..repeats).all(|repeat| at(appendage, repeat, i) == first);
            first.filter(|_| (0..self.count).all(same))
        };
        (0..size).map(common).collect()
    }
}

#[derive(Default)]
struct Rolled {
    functions: Vec<TokenStream>,
    prepare: Vec<TokenStream>,
    constants: usize,
    calls: Vec<Call>,
    at_origin: Vec<bool>,
    evaluation: Operations,
    preparation: Operations,
}

/// A traced step and where its constants stand.
pub(crate) struct Placed {
    pub traced: Traced,
    pub start: usize,
}

impl Rolled {
    fn add_group(&mut self, request: &Request, group: &Equal) {
        match group.shape {
            Shape::Chain(links) => self.add_chains(request, group, links),
            Shape::Paddle => self.add_paddles(request, group),
        }
    }

    /// Traces a step, emits its functions and makes room for its constants.
    fn place(
        &mut self,
        request: &Request,
        group: &Equal,
        traced: Traced,
        offset: usize,
        parameters: usize,
        repeats: usize,
    ) -> Placed {
        self.functions.push(traced.functions(request.level));
        for _ in 0..repeats * group.count {
            self.evaluation = self.evaluation + traced.operations();
            self.preparation = self.preparation + traced.preparation();
        }
        let start = self.constants;
        let size = traced.constants();
        if size > 0 {
            self.constants += size * repeats * group.count;
            let name = traced.prepare_name();
            let [count, stride, first, link, size_, parameters, start_, repeats_] = [
                group.count,
                group.parameters(),
                group.parameter + offset,
                Layout::LINK,
                size,
                parameters,
                start,
                repeats,
            ]
            .map(Literal::usize_unsuffixed);
            self.prepare.push(quote! {
                for a in 0..#count {
                    for i in 0..#repeats_ {
                        let at = #first + a * #stride + i * #link;
                        let constants = #name(&p[at..at + #parameters]);
                        for (c, &constant) in constants.iter().enumerate() {
                            k[#start_ + (i * #size_ + c) * #count + a] = constant;
                        }
                    }
                }
            });
        }
        Placed { traced, start }
    }

    fn add_chains(&mut self, request: &Request, group: &Equal, links: usize) {
        let prefix = group.prefix();
        let branch = group.pinned(request, 0, Layout::BRANCH, 1);
        let link = group.pinned(request, Layout::BRANCH, Layout::LINK, links);
        let trace = |stage: &Stage<Expr>, pinned: &[Option<f64>], masks: &Masks| {
            Traced::new(&prefix, stage, pinned, masks)
        };
        let outward = trace(&stages::outward(), &link, &Masks::new());
        let start = trace(&stages::start(), &branch, &Masks::new())
            .passing_on(REACHED, outward.live(REACHED));
        let mut masks = Masks::from([
            (TURNED.name, outward.live(TURNED).to_vec()),
            (SHOWN.name, vec![false; SHOWN.size]),
        ]);
        let inward = settled(&mut masks, SHOWN, |masks| trace(&stages::inward(), &link, masks));
        let root = trace(&stages::root(), &branch, &masks);
        let first = trace(&stages::first(), &branch, &Masks::new());
        masks.insert(ELIMINATED.name, inward.live(ELIMINATED).to_vec());
        let back = trace(&stages::back(), &[], &masks);
        let place = |rolled: &mut Self, traced, of_links: bool| {
            let (offset, size, repeats) = if of_links {
                (Layout::BRANCH, Layout::LINK, links)
            } else {
                (0, Layout::BRANCH, 1)
            };
            rolled.place(request, group, traced, offset, size, repeats)
        };
        let start = place(self, start, false);
        let outward = place(self, outward, true);
        let inward = place(self, inward, true);
        let root = place(self, root, false);
        let first = place(self, first, false);
        let back = place(self, back, true);
        self.functions.push(chain_sweeps(
            group,
            links,
            [&start, &outward, &inward, &root, &first, &back],
        ));
        self.evaluation.angles += links * group.count;
        let saved = [(inward.traced.size(ELIMINATED), Some(links))];
        self.call(group, &saved, root.traced.live(AT_ORIGIN));
    }

    fn add_paddles(&mut self, request: &Request, group: &Equal) {
        let prefix = group.prefix();
        let whole = group.pinned(request, 0, group.parameters(), 1);
        let branch = group.pinned(request, 0, Layout::BRANCH, 1);
        let inward = Traced::new(&prefix, &stages::paddle_in(), &whole, &Masks::new());
        let first = Traced::new(&prefix, &stages::first(), &branch, &Masks::new());
        let masks = Masks::from([
            (ELIMINATED.name, inward.live(ELIMINATED).to_vec()),
            (PADDLE.name, inward.live(PADDLE).to_vec()),
        ]);
        let back = Traced::new(&prefix, &stages::paddle_back(), &[], &masks);
        let inward = self.place(request, group, inward, 0, group.parameters(), 1);
        let first = self.place(request, group, first, 0, Layout::BRANCH, 1);
        let back = self.place(request, group, back, 0, 0, 1);
        self.functions.push(paddle_sweeps(group, &inward, &first, &back));
        let saved = [(inward.traced.size(ELIMINATED), None), (inward.traced.size(PADDLE), None)];
        self.call(group, &saved, inward.traced.live(AT_ORIGIN));
    }

    /// Has a group's sweeps called: `saved` has the sizes of what its inward sweep leaves, once
    /// or for each link, and `live` tells which numbers at O it returns.
    fn call(&mut self, group: &Equal, saved: &[(usize, Option<usize>)], live: &[bool]) {
        self.at_origin.resize(AT_ORIGIN.size, false);
        for (all, live) in self.at_origin.iter_mut().zip(live) {
            *all |= live;
        }
        let (inward, outward) = names(group);
        let empty = saved.iter().map(|&(size, repeats)| {
            let size = Literal::usize_unsuffixed(size);
            match repeats.map(Literal::usize_unsuffixed) {
                Some(repeats) => quote!([[P::zero(); #size]; #repeats]),
                None => quote!([P::zero(); #size]),
            }
        });
        self.calls.push(Call {
            inward,
            outward,
            number: group.number,
            count: group.count,
            empty: quote!((#(#empty,)*)),
            seen: (0..AT_ORIGIN.size).filter(|&slot| live[slot]).collect(),
        });
    }

    fn finish(mut self, request: &Request) -> Generated {
        self.at_origin.resize(AT_ORIGIN.size, false);
        let masks = Masks::from([
            (AT_ORIGIN.name, self.at_origin.clone()),
            (stages::EXTERNAL.name, vec![request.external; stages::EXTERNAL.size]),
        ]);
        let main = &request.pinned[..Layout::MAIN];
        let base = Traced::new("m", &stages::base(), main, &masks).regrouped(request.level);
        let alone = Equal { number: 0, shape: Shape::Chain(0), count: 1, parameter: 0, hinge: 0 };
        let base = self.place(request, &alone, base, 0, Layout::MAIN, 1);
        let main_body = self.main_body(request, &base);
        let driver = Driver { calls: self.calls, main_body };
        let prepare = &self.prepare;
        let signature = Signature::of(request);
        let item = Item {
            signature: &signature,
            constants: self.constants,
            prepare: quote!(#(#prepare)*),
            evaluate: driver.on_any_scalar(),
            evaluate_packed: driver.in_packs(),
            functions: TokenStream::new(),
        }
        .tokens();
        let functions = &self.functions;
        Generated {
            tokens: quote!(#item #(#functions)*),
            evaluation: self.evaluation,
            preparation: self.preparation,
        }
    }

    /// From what all appendages show at O to the accelerations of the main body.
    fn main_body(&self, request: &Request, base: &Placed) -> TokenStream {
        let live = (0..AT_ORIGIN.size).filter(|&slot| self.at_origin[slot]);
        let live = live.map(Literal::usize_unsuffixed);
        let external = (3..9).filter(|_| request.external).map(Literal::usize_unsuffixed);
        let six = (0..6).map(Literal::usize_unsuffixed);
        let name = &base.traced.name;
        let constants = gather_constants(base, 1, &Whose::MainBody);
        quote! {
            let omega = [P::spread(x[0]), P::spread(x[1]), P::spread(x[2])];
            let (main,) = #name(
                #constants
                omega,
                [#(P::spread(x[#external])),*],
                [#(P::spread(seen[#live])),*],
            );
            let main = [#(Pack::<S>::sum(main[#six])),*];
            out[..6].copy_from_slice(&main);
        }
    }
}

/// Traces again and again until the numbers of `group` that can be other than zero stay the
/// same.
fn settled(masks: &mut Masks, group: Group, trace: impl Fn(&Masks) -> Traced) -> Traced {
    loop {
        let traced = trace(masks);
        let known = masks.get_mut(group.name).expect("the group has a mask to begin with");
        let mut grown = false;
        for (known, live) in known.iter_mut().zip(traced.live(group)) {
            grown |= *live && !*known;
            *known |= *live;
        }
        if !grown {
            return traced.passing_on(group, known);
        }
    }
}
