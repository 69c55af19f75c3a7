//! The modules of a crate as `syn` parses them: what each declares, imports and mentions.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};
use syn::{Item, ItemUse, UseTree, Visibility};

/// A path as it is written, `["super", "Name"]`.
pub type Names = Vec<String>;

/// What a module imports under a name of its own.
pub struct Import {
    pub name: String,
    pub path: Names,
    /// Whether others can reach it through this module (`pub use`, `pub(crate) use`).
    pub passed_on: bool,
}

/// A module, in a file of its own or in braces.
#[derive(Default)]
pub struct Module {
    /// Relative to the folder of the crate's root.
    pub file: PathBuf,
    pub parent: usize,
    pub children: BTreeMap<String, usize>,
    /// Names of children in the order of their declarations.
    pub declared: Vec<String>,
    /// Names of functions, types, traits, constants and macros that are defined here.
    pub items: BTreeSet<String>,
    pub imports: Vec<Import>,
    /// What is imported with a star, and whether it is passed on.
    pub stars: Vec<(Names, bool)>,
    /// All other paths of the code, also within macros.
    pub mentions: Vec<Names>,
    /// Names of methods that are called.
    pub methods: BTreeSet<String>,
    /// Whether it has arrays of three numbers.
    pub triples: bool,
    /// Whether macros define items here, whose names are not seen.
    pub has_item_macros: bool,
    /// Whether it is a module of tests in braces.
    pub tests_in_braces: bool,
}

/// All modules of the crate whose root file is `root`, which comes first; each after its parent.
pub fn modules(root: &Path) -> Vec<Module> {
    let mut modules = Vec::new();
    let folder = root.parent().expect("a folder");
    load(root, folder, folder, 0, &mut modules);
    modules
}

/// Reads a file and those of its children, which are in `folder`; returns its index.
fn load(file: &Path, folder: &Path, base: &Path, parent: usize, modules: &mut Vec<Module>) -> usize {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let file = file.strip_prefix(base).expect("inside the crate");
    add(&parsed.items, file, folder, base, parent, modules)
}

fn add(items: &[Item], file: &Path, folder: &Path, base: &Path, parent: usize, modules: &mut Vec<Module>) -> usize {
    let index = modules.len();
    modules.push(Module { file: file.to_owned(), parent, ..Module::default() });
    let mut module = Module { file: file.to_owned(), parent, ..Module::default() };
    for item in items {
        if let Item::Mod(child) = item {
            let name = child.ident.to_string();
            module.declared.push(name.clone());
            let inside = folder.join(&name);
            let loaded = match &child.content {
                Some((_, items)) => {
                    module.tests_in_braces |= child.attrs.iter().any(|attribute| attribute.path().is_ident("cfg"));
                    add(items, file, &inside, base, index, modules)
                }
                None => {
                    let own = folder.join(format!("{name}.rs"));
                    let path = if own.exists() { own } else { inside.join("mod.rs") };
                    load(&path, &inside, base, index, modules)
                }
            };
            module.children.insert(name, loaded);
        } else {
            module.items.extend(name_of(item));
            module.visit_item(item);
        }
    }
    modules[index] = module;
    index
}

fn name_of(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(item) => item.ident.to_string(),
        Item::Enum(item) => item.ident.to_string(),
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Macro(item) => item.ident.as_ref()?.to_string(),
        Item::Static(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        Item::Trait(item) => item.ident.to_string(),
        Item::TraitAlias(item) => item.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        Item::Union(item) => item.ident.to_string(),
        _ => return None,
    })
}

impl Module {
    /// Paths that are imported, also with a star, and whether they are passed on.
    pub fn imported(&self) -> impl Iterator<Item = (&Names, bool)> {
        let single = self.imports.iter().map(|import| (&import.path, import.passed_on));
        single.chain(self.stars.iter().map(|(path, passed_on)| (path, *passed_on)))
    }

    /// All paths, imported or mentioned.
    pub fn paths(&self) -> impl Iterator<Item = &Names> {
        self.mentions.iter().chain(self.imported().map(|(path, _)| path))
    }

    fn import(&mut self, tree: &UseTree, before: &Names, passed_on: bool) {
        let with = |name: &str| before.iter().cloned().chain([name.to_owned()]).collect::<Names>();
        let mut import = |last: String, name: String| {
            let path = if last == "self" { before.clone() } else { with(&last) };
            let name = if name == "self" { before.last().cloned().unwrap_or_default() } else { name };
            self.imports.push(Import { name, path, passed_on });
        };
        match tree {
            UseTree::Path(path) => self.import(&path.tree, &with(&path.ident.to_string()), passed_on),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.import(tree, before, passed_on)),
            UseTree::Name(name) => import(name.ident.to_string(), name.ident.to_string()),
            UseTree::Rename(renamed) => import(renamed.ident.to_string(), renamed.rename.to_string()),
            UseTree::Glob(_) => self.stars.push((before.clone(), passed_on)),
        }
    }

    /// Paths in the tokens of a macro: names with `::` between them.
    fn scan(&mut self, tokens: TokenStream) {
        let (mut path, mut colons) = (Names::new(), 0);
        for token in tokens {
            match token {
                TokenTree::Ident(name) => {
                    if colons != 2 && !path.is_empty() {
                        self.mentions.push(std::mem::take(&mut path));
                    }
                    path.push(name.to_string());
                    colons = 0;
                    continue;
                }
                TokenTree::Punct(point) if point.as_char() == ':' && !path.is_empty() => {
                    colons += 1;
                    continue;
                }
                TokenTree::Group(group) => self.scan(group.stream()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
            if !path.is_empty() {
                self.mentions.push(std::mem::take(&mut path));
            }
            colons = 0;
        }
        if !path.is_empty() {
            self.mentions.push(path);
        }
    }
}

impl<'ast> Visit<'ast> for Module {
    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let passed_on = !matches!(item.vis, Visibility::Inherited);
        self.import(&item.tree, &Names::new(), passed_on);
    }

    /// `pub(super)` is no use.
    fn visit_vis_restricted(&mut self, _: &'ast syn::VisRestricted) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.mentions.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, called: &'ast syn::Macro) {
        self.scan(called.tokens.clone());
        visit::visit_macro(self, called);
    }

    fn visit_item_macro(&mut self, item: &'ast syn::ItemMacro) {
        self.has_item_macros |= item.ident.is_none();
        visit::visit_item_macro(self, item);
    }

    fn visit_meta_list(&mut self, list: &'ast syn::MetaList) {
        self.scan(list.tokens.clone());
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        self.methods.insert(call.method.to_string());
        visit::visit_expr_method_call(self, call);
    }

    fn visit_type_array(&mut self, array: &'ast syn::TypeArray) {
        let number =
            matches!(&*array.elem, syn::Type::Path(path) if path.path.is_ident("f64") || path.path.is_ident("f32"));
        let three = matches!(&array.len, syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(count), .. }) if count.base10_digits() == "3");
        self.triples |= number && three;
        visit::visit_type_array(self, array);
    }
}
