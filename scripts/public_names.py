"""The public names of the library, as Doxygen finds them in its headers, and what is said of each."""
import collections
import pathlib
import re
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOXYFILE = """
INPUT = include/dovetail
FILE_PATTERNS = *.hpp
RECURSIVE = YES
STRIP_FROM_PATH = include
EXCLUDE_SYMBOLS = detail detail::* *::detail *::detail::*
EXTRACT_ALL = YES
EXTRACT_STATIC = YES
SEARCH_INCLUDES = NO
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = "Handle(type)=opencascade::handle<type>"
FILTER_PATTERNS = *netgen*.hpp="sed '/#include <nglib.h>/s/.*//'"
HAVE_DOT = NO
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_IF_INCOMPLETE_DOC = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""
TYPE_KINDS = ("struct", "class", "union")
ROLES = {"mesher": "mesher", "simplification": "simplifier", "improver": "improvement", "parallel": "parallel", "partition": "partition"}
OF_CONTAINERS = {"begin", "end", "size", "empty", "data", "operator[]", "clear", "reserve", "push_back", "resize", "front", "back"}


def plain(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def descriptions_of(element):
    return [part for part in (element.find("briefdescription"), element.find("detaileddescription")) if part is not None]


def without_arguments(name):
    """The name of a template: what a specialisation is one of."""
    return re.sub(r"<.*", "", name).strip() if not name.startswith("operator") else name


class Name:
    """A public name: a concept, type, function, alias, enumeration, constant or member, with all its declarations."""

    def __init__(self, kind, qualified, element):
        self.kind, self.qualified = kind, qualified
        self.short = qualified.split("::")[-1]
        self.elements = [element]
        self.members = {}
        self.bases = []
        self.inherited = None  # (concept, what its comment says), of a member without a description of its own

    def header(self):
        return self.elements[0].find("location").get("file")

    def place(self):
        location = self.elements[0].find("location")
        return f"include/{location.get('file')}:{location.get('line')}"

    def blocks(self):
        """The elements with what is said of it; of overloads each that says something."""
        return [part for element in self.elements for part in descriptions_of(element) if plain(part)]

    def anchor(self):
        return re.sub(r"[^a-z0-9]+", "-", self.qualified.lower().replace("operator()", "call")
                      .translate({ord(c): f" {ord(c):x} " for c in "=<>!+-*/[]&|~"})).strip("-")


class Library:
    def __init__(self, xml):
        self.names = {}  # qualified -> Name, members not included
        self.of_id = {}  # Doxygen's ids -> Name
        self.headers = {}  # header -> the element with what it says of itself
        self.models = collections.defaultdict(set)  # concept -> types
        roots = [ElementTree.parse(file).getroot() for file in sorted(xml.glob("*.xml"))]
        compounds = [compound for root in roots for compound in root.iter("compounddef")]
        for compound in sorted(compounds, key=lambda c: c.get("kind") == "namespace"):
            self.add_compound(compound)
        self.nest()
        self.by_short = collections.defaultdict(list)
        for name in self.names.values():
            self.by_short[name.short].append(name)
        self.find_models()
        self.inherit()

    def add_compound(self, compound):
        kind, qualified = compound.get("kind"), plain(compound.find("compoundname"))
        if kind == "file":
            self.headers[compound.find("location").get("file")] = compound
        elif kind == "namespace":
            for member in compound.iter("memberdef"):
                self.add_member(self.names, member, qualified)
        elif kind in TYPE_KINDS + ("concept",) and compound.get("prot") in (None, "public"):
            name = without_arguments(qualified)
            known = self.names.setdefault(name, Name(kind, name, compound))
            if known.elements[0] is not compound:
                place = 0 if "<" not in qualified else len(known.elements)
                known.elements.insert(place, compound)
            known.bases += [(base.get("refid"), plain(base)) for base in compound.findall("basecompoundref") if base.get("prot") == "public"]
            self.of_id[compound.get("id")] = known
            for member in compound.iter("memberdef"):
                self.add_member(known.members, member, name)

    def add_member(self, names, member, scope):
        kind, short = member.get("kind"), plain(member.find("name"))
        guide = kind == "function" and re.search(r"\) ?-> ?" + re.escape(short) + r"\b", plain(member.find("argsstring")))
        if member.get("prot") == "private" or kind in ("friend", "define") or guide or "_" == short[:1]:
            return
        qualified = f"{scope}::{short}"
        if names is self.names and qualified in names and names[qualified].kind in TYPE_KINDS:
            return
        known = names.setdefault(qualified, Name(kind, qualified, member))
        if known.elements[0] is not member:
            known.elements.append(member)
        self.of_id[member.get("id")] = known

    def nest(self):
        """Types inside of types become members of these, if these are public."""
        for qualified, name in list(self.names.items()):
            scope = qualified.rpartition("::")[0]
            if scope in self.names and self.names[scope].kind in TYPE_KINDS:
                self.names[scope].members[qualified] = name
                del self.names[qualified]

    def find_owner(self, member):
        """The type that a member is declared in."""
        return next(name for name in self.of_id.values() if member in name.members.values())

    def find(self, words):
        """The public name that is meant by a word in a comment, or None."""
        found = [name for name in self.by_short.get(words.split("::")[-1], []) if f"::{name.qualified}".endswith(f"::{words}")]
        if len(found) > 1:
            found = [name for name in found if name.qualified == f"dovetail::{words}"] or \
                    [name for name in found if name.kind != "function"]
        return found[0] if len(found) == 1 else None

    def find_models(self):
        concepts = [name for name in self.names.values() if name.kind == "concept"]
        self.unknown = []  # what comments call models, and nothing is
        members = {member.short for name in self.names.values() for member in name.members.values()}
        for concept in concepts:
            paragraphs = [plain(paragraph) for block in concept.blocks() for paragraph in block.iter("para")]
            listed = " ".join(text[7:] for text in paragraphs if text.startswith("Models:"))
            for word in re.findall(r"[a-z_:]*[a-z_]\w*", re.split(r"\. |\binside\b", listed)[0]):
                if not self.add_model(concept, word) and re.search("_|::", word) and not self.find(word) and word not in members:
                    self.unknown.append(f"{concept.place()}: the model {word} of {concept.qualified} does not exist")
        by_short = {concept.short: concept for concept in concepts}
        asserted = re.compile(r"(?<![!\w])(" + "|".join(by_short) + r")<((?:[a-z]\w*::)*[a-z]\w*)(?:<\w*>)?(?:, \d)?>")
        for folder in ("include", "tests", "examples"):
            for file in sorted((ROOT / folder).rglob("*.?pp")):
                for statement in re.findall(r"static_assert\((.*?)\);", file.read_text(), re.S):
                    for concept, model in asserted.findall(statement):
                        self.add_model(by_short[concept], model)
        for refined in concepts:  # a model of what refines a concept is a model of the concept
            text = plain(refined.elements[0].find("initializer")).partition(" = ")[2]
            for word in re.findall(r"\b(\w+)\s?<", text.partition("requires")[0]):
                if word in by_short:
                    self.models[by_short[word].qualified] |= self.models[refined.qualified]

    def add_model(self, concept, word):
        model = self.find(word)
        if not model:  # of several of that name the one beside other models of the concept's role
            found = [name for name in self.by_short.get(word, []) if name.qualified.split("::")[-2] == ROLES.get(concept.header().split("/")[1])]
            model = found[0] if len(found) == 1 else None
        if model and model.kind in TYPE_KINDS + ("typedef",):
            self.models[concept.qualified].add(model.qualified)
        return model

    def concepts_of(self, type_name):
        return [self.names[concept] for concept in sorted(self.models) if type_name in self.models[concept]]

    def inherit(self):
        """What concepts, base classes, and the members beside them say of members that say nothing themselves."""
        said = {concept: said_of_members(self.names[concept]) for concept in self.models}
        types = [name for name in self.names.values() if name.kind in TYPE_KINDS]
        for name in types:
            types += [member for member in name.members.values() if member.kind in TYPE_KINDS]
            sources = [(self.names[c.qualified], said[c.qualified]) for c in self.concepts_of(name.qualified)]
            named_in = {plain(code): said_by for said_by in [*name.members.values(), name]
                        for block in said_by.blocks() for code in block.iter("computeroutput")}
            on_line = {member.place(): member for member in name.members.values() if member.kind == "variable" and member.blocks()}
            for member in name.members.values():
                if member.kind == "variable" and not member.blocks() and member.place() in on_line:
                    member.inherited = (on_line[member.place()], None)  # declared together
                if member.short == "fields":
                    member.inherited = (self.names["dovetail::has_fields"], None)
                if not member.blocks() and member.short in named_in:
                    member.inherited = (named_in[member.short], None)
                for concept, of_members in sources:
                    if not member.blocks() and member.short in of_members:
                        member.inherited = member.inherited or (concept, of_members[member.short])
                for refid, _ in name.bases:
                    base = self.of_id.get(refid)
                    described = base and base.members.get(f"{base.qualified}::{member.short}")
                    if described and described.blocks() and not member.blocks():
                        member.inherited = member.inherited or (base, described.blocks()[0])

    def faults(self):
        for header, element in sorted(self.headers.items()):
            if not any(plain(part) for part in descriptions_of(element)):
                yield f"include/{header}: it does not say what it is"
        for name in self.names.values():
            yield from faults_of(name)
        yield from self.unknown


def faults_of(name):
    if not name.blocks():
        yield f"{name.place()}: {name.qualified} has no description"
    for member in name.members.values():
        owner = name.short
        is_special = member.short in (owner, f"~{owner}", "operator=", "operator==") or \
            member.kind == "function" and member.short in OF_CONTAINERS
        if member.kind in TYPE_KINDS:
            yield from faults_of(member)
        elif not is_special and not member.blocks() and not member.inherited:
            yield f"{member.place()}: {member.qualified} has no description"
        if member.kind == "enum":
            yield from faults_of_values(member)
    if name.kind == "enum":
        yield from faults_of_values(name)


def faults_of_values(name):
    named = {plain(code) for block in name.blocks() for code in block.iter("computeroutput")}
    for value in name.elements[0].findall("enumvalue"):
        if not any(plain(part) for part in descriptions_of(value)) and plain(value.find("name")) not in named:
            yield f"{name.place()}: {name.qualified}::{plain(value.find('name'))} has no description"


def said_of_members(concept):
    """Of the comment of a concept, what it says of each member of a model: an item of a list, or None."""
    found = {}
    for block in concept.blocks():
        for parent in [*block.iter("listitem"), *block.iter("para")]:
            for code in parent.iter("computeroutput"):
                match = re.match(r"(?:\w+(?:\.|::)(\w+)|\w+)(\(|$)", plain(code))
                if match and (match.group(1) or match.group(2)):
                    found.setdefault(match.group(1) or "operator()", parent if parent.tag == "listitem" else None)
    return found


def read_library():
    """The library, and whether Doxygen had nothing to complain of; it says on stderr what it has."""
    with tempfile.TemporaryDirectory() as made:
        run = subprocess.run(["doxygen", "-"], input=f"{DOXYFILE}OUTPUT_DIRECTORY = {made}\n", cwd=ROOT, text=True)
        return Library(pathlib.Path(made) / "xml"), run.returncode == 0
