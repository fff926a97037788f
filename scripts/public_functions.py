"""What the reference says of functions: parameters with their meaning, what kind of thing each sentence tells, and the
examples that call them."""
import collections
import functools
import re

from public_names import ROOT, plain

LABELS = (  # of sentences in the description of a function, by how they begin
    ("Errors", r"(Throws|Refuses|Never throws|Nothing is thrown|The errors? of|Errors:)"),
    ("Complexity", r"(Complexity: |(About |At most |Otherwise )?([Ll]inear|[Cc]onstant|[Qq]uadratic|[Ll]ogarithmic|O\(|n log n)|Amortised\b)"),
    ("Determinism", r"(Deterministic|Depends on nothing but|The same for any number of|Bit for bit)\b"),
    ("Source", r"(After [A-Z]\.|Paper, section|J\. Chen et al\.|Source:)"),
)
ERRORS = re.compile(r"\b[Tt]hrows?\b|\b[Tt]hrown\b|_error\b|Refuses")
COMPLEXITY = re.compile(r"Complexity|\b[Ll]inear|O\(|[Cc]onstant time|n log n|[Qq]uadratic|in the (number|size) of")

WORDS = (  # parameters that mean the same everywhere: name, type, meaning; the first that fits counts
    (r"path|file|geo_file", r"filesystem::path", "a file"),
    (r"path|file|name|source|what|where", r"string", "what messages call the input: a file's name, most often"),
    (r"folder|directory", r"filesystem::path", "a folder"),
    (r"data|content|text|line|word|said", r"string", "the text"),
    (r"[abcdepqxyz]|at|place|point|position|from|to|start|end|apex|centre|origin|first|last|middle|lower|upper", r"vec[23]",
     "a point in the units of the model, or a vector"),
    (r"direction|axis|normal|up|along|tangent|edge|shift|step", r"vec[23]", "a vector"),
    (r"uv|parameters?", r"vec2", "parameters (u, v) of a surface"),
    (r"points?|nodes|places|corners|positions|coarse_points|given", r"vec[23]", "coordinates in the units of the model"),
    (r"p|corners|nodes|points|x", r"array< ?vec[23]", "the corners' coordinates"),
    (r"triangles?|tetrahedra|elements|sides|edges|simplices|segments|curve_edges", r"simplex<|array< ?local_id", "per simplex the numbers of its points, from 0"),
    (r"label|labels|part|parts|part_of_\w+|piece_of_\w+|subdomain_of_\w+|super_of_\w+|rank_of_\w+|component_of_\w+|chart_of|shell_of|tags|of_\w+|rank",
     r"(span|vector)<", "per item the number of what it belongs to, from 0"),
    (r"weights?|node_weights|element_weights|component_weights|penalt\w+|values", r"(span|vector)< ?(const )?double", "one value each"),
    (r"ids|side_ids|hosts|names", r"(span|vector)<", "one each"),
    (r"listed|members|items|chosen|failed|wanted|faces|kept|nodes|sides|triangles|elements|facets|solids|curves|ordered|order", r"(span|vector)< ?(const )?(local_id|std::size_t|std::uint\w+|T)\b",
     "numbers of items, from 0"),
    (r"part|parts|pieces|ranks|subdomains|layers|count|\w*_count|points|rows|triangles|elements|labels|most|number|given_points|bits|workers|digits|n|total|bytes|given", r"int|size_t|local_id|uint\w+|double",
     "how many"),
    (r"[fijkentsuvwhp]|index|face|solid|curve|side|element|point|piece|rank|subdomain|vertex|node|line|edge|host|triangle|component|position|corner|item|label|row|id|solid_\w+|face_\w+|a|b|c",
     r"local_id|size_t|int|unsigned|half_side|uint\w+|global_id", "its number, from 0"),
    (r"\w*_deg|angle|feature_angle", r"double", "an angle in degrees"),
    (r"\w*_radians|\w*turn", r"double", "an angle in radians"),
    (r"limit_seconds|seconds|\w+_seconds", r"double", "a time in seconds"),
    (r"tolerance|sliver_height|margin|radius|length|height|distance|spacing|inner|outer|nose|tail|size|h|smallest|largest|reach|width|deflection|thickness|target", r"double",
     "a length in the units of the model"),
    (r"growth|factor|scale|ratio|fraction|imbalance|t|share|relative_\w+", r"double", "a ratio, without a unit"),
    (r"h|size|sizing|field|given_size|sizes", r"(const )?(H|Field|Sizing|S|Size)\b", "edge lengths wanted, in the units of the model"),
    (r"model|given_model|geometry", r"(const )?(G|Model|Geometry)\b", "a geometry model"),
    (r"graph|g", r"(const )?(G|Graph)\b", "a graph"),
    (r"graph|g|whole", r"csr_graph", "a weighted graph in compressed rows"),
    (r"duals?|sides|edg|sdg", r"(const )?(G|Graph|E|S|Duals?)\b", "a dual graph"),
    (r"mesher|mesh_it|surface_mesher", r"(const )?(M|Mesher|SurfaceMesher|S)\b", "what meshes"),
    (r"improver?|improve_it", r"(const )?(I|Improver)\b", "what improves"),
    (r"partitioner|partition", r"(const )?(P|Partitioner)\b", "what divides a graph"),
    (r"rule", r"(const )?(R|Rule|Simplification)\b", "a simplification rule"),
    (r"policy|policies|given|parameters", r"(Parameters|Policy|Policies|P)\b", "policies and options"),
    (r"run|run_tasks|executor", r"(Executor|E|Run)\b", "what carries out independent tasks"),
    (r"writer|reader|format|communicator|measure|operation", r"[A-Z]\w*\b", "a model of the concept that the declaration names"),
    (r"item|items|value|object|x|result|input|list|others|sequence|visited|list", r"(const )?(T|Item|Items|Sequence|Value|std::tuple|std::array|std::vector).*", "the value, or the values"),
    (r"\w+", r"TopoDS_\w+|TopAbs_\w+", "a shape of OpenCASCADE, or a kind of shape"),
    (r"\w+", r"gp_\w+|handle<|Handle\(|TDF_Label", "an object of OpenCASCADE"),
    (r"\w*_?dimension", r"int", "2 or 3; of boundary entities 0 to 2"),
    (r"is_\w+|binary|quadratic|second_order|reversed|flipped|own|kept|paid|on|ghosts|tangled|swapped|text", r"bool", "whether it is so"),
    (r"is_\w+|marked", r"(vector|span)<", "whether it is so, one each"),
    (r"stem|extension|key|name_of|kind|part|role|stage|step|section|library|task|reason|type|face|head|what|object", r"string|char", "a name in messages, files or reports"),
    (r"strings|reasons|arrays|group_names", r"string", "texts, one each"),
    (r"failure", r"exception_ptr", "what was thrown"),
    (r"data|out|bytes|block", r"(span|vector)< ?(const )?(std::)?(uint8_t|byte|char)", "bytes"),
    (r"from|to|unfinished", r"filesystem::path", "a path"),
    (r"visit|offer|make_result|read|f|take|put|work|task|repair|bisect", r"(const )?(std::function.*|[A-Z]\w*)", "a callable"),
    (r"keys|costs|limits|shares|sizes|parameters|values|edge_range|range|box", r"(span|vector|array)<", "one value each"),
    (r"less", r".*", "whether one item comes before another"),
    (r"a|b", r"(const )?[AB]\b|(const )?T\b|triple<.*", "one of the operands"),
    (r"out|stream", r"ostream", "where text goes"),
)
WITHOUT_OWN_CONTRACT = ("core/", "improver/shape_measure.hpp", "models/occt/", "models/discrete/", "files/vtk_arrays.hpp",
                        "files/msh_encoder.hpp", "improver/tetrahedra/")  # arithmetic, containers, parts of models, readers, improver
MAIN = re.compile(  # beside what documents call: what reads, writes, checks and measures, and the steps of stages
    r"(read|write|check|measure(?!_of)|require)_\w+|contract|contract_bounded|make_csr_graph|edge_cut|imbalance_of|interface_faces|number_lines|remesh_line|"
    r"boundary_of_subdomain|skeleton_of_lines|mesh_patches|join_patches|mesh_regions|plan_background|triangulate_points|recover_boundary|"
    r"triangulate_loops|parse_sizing|map_tasks|checked_partition|enclosed_volume|crossing_facets|mesh_hash|number_globally|enclosed_regions|"
    r"element_neighbours|find_side|build_ridges|improve_on_host|generate_from_background|mesh_again|as_matrix|zero_matrix")


def parameters_of(element):
    """(name, type as an element, default as an element, array) of each parameter of a declaration."""
    for parameter in element.findall("param"):
        kind = parameter.find("type")
        if plain(kind) != "void" or plain(parameter.find("declname")):
            yield plain(parameter.find("declname")), kind, parameter.find("defval"), plain(parameter.find("array"))


def said_of_parameters(name):
    """Parameter -> the element with what \\param says of it."""
    found = {}
    for block in name.blocks():
        for item in block.iter("parameteritem"):
            for word in item.iter("parametername"):
                found.setdefault(plain(word), item.find("parameterdescription"))
    return found


def word_for(name, kind):
    """What a parameter of this name and type means everywhere, or None."""
    for names, types, meaning in WORDS:
        if re.fullmatch(names, name) and re.search(rf"(^|\W|::)({types})", kind):
            return meaning
    return None


def names_in_code(name):
    """The words in code font of a description."""
    return {word for block in name.blocks() for code in block.iter("computeroutput") for word in re.findall(r"\w+", plain(code))}


def labelled(text):
    """A paragraph as what it says and [label, text] of what is of a known kind, with the sentences that refer to it."""
    rest, labels = [], []
    for sentence in re.split(r"(?<=[.)]) (?=[A-Z])", text):
        label = next((label for label, begins in LABELS if re.match(begins, sentence)), None)
        if label:
            labels.append([label, re.sub(r"^(Complexity|Source|Errors): ", "", sentence)])
        elif labels and re.match(r"(It|This|These|That|Those|They|So|Else|Both|Otherwise|All of them|Each of)\b", sentence):
            labels[-1][1] += f" {sentence}"
        else:
            rest.append(sentence)
    order = [label for label, _ in LABELS]
    return " ".join(rest), sorted(labels, key=lambda found: order.index(found[0]))


# Which examples use a name

@functools.lru_cache
def included_by(path):
    """The headers that a file includes, itself or by others."""
    found = set()
    todo = [path]
    while todo:
        file = todo.pop()
        for header in re.findall(r'#include "([^"]+)"', file.read_text()):
            there = next((folder / header for folder in (ROOT / "include", file.parent) if (folder / header).exists()), None)
            if there and header not in found:
                found.add(header)
                todo.append(there)
    return frozenset(found)


def arguments_at(code, start):
    """The number of arguments of the call whose bracket opens at start, and the same without what template brackets hide."""
    depth, end = 0, start
    for end in range(start, len(code)):
        depth += (code[end] in "([{") - (code[end] in ")]}")
        if depth == 0:
            break
    counts = []
    inside = code[start + 1:end]
    for text in (inside, re.sub(r"<[\w:, <>]*>", "", inside)):
        depth = commas = 0
        for letter in text:
            depth += (letter in "([{") - (letter in ")]}")
            commas += letter == "," and depth == 0
        counts.append(commas + 1 if text.strip() else 0)
    return counts


def takes(name, counts):
    """Whether an overload takes one of these numbers of arguments."""
    for element in name.elements:
        listed = list(parameters_of(element))
        least = sum(default is None for _, _, default, _ in listed)
        most = 99 if any("..." in plain(kind) for _, kind, _, _ in listed) else len(listed)
        if any(min(least, most) <= count <= most or most == 99 for count in counts):
            return True
    return False


def users_of(names, folder="examples"):
    """Qualified name -> the examples that use it: whose includes reach its header, and in which its word stands where
    the name is visible, is no local of the example and, of a function, is called with so many arguments as it takes."""
    users = collections.defaultdict(list)
    for file in sorted((ROOT / folder).glob("*.?pp")):
        code = re.sub(r'//.*|"[^"\n]*"', '""', file.read_text())
        headers = included_by(file)
        open_scopes = {f"dovetail::{scope}".replace("dovetail::dovetail", "dovetail") for scope in re.findall(r"using namespace ([\w:]+);", code)}
        open_names = set(re.findall(r"using ((?:\w+::)+\w+);", code))
        aliases = dict(re.findall(r"namespace (\w+) = ([\w:]+);", code))
        locals_ = set(re.findall(r"(?:\bauto|\bconst|\bdouble|\bint|[\w>]&|\w>|\b[a-z]\w*_\w+|\bstd::\w+|\bvec3)[&*]? (\w+)\s*(?:=|;|\{|,|\)|:[^:])", code))
        locals_ |= set(re.findall(r"\b(?:struct|class|concept|using|namespace) (\w+)", code))
        locals_ |= {word for group in re.findall(r"auto&? \[([\w, ]+)\]", code) for word in group.split(", ")}
        uses = collections.defaultdict(list)
        for found in re.finditer(r"(\.|->)?(?<!\w)((?:\w+::)*)(\w+)", code):
            if not found[1]:
                uses[found[3]].append(found)
        for name in names:
            if name.header() not in headers:
                continue
            outer = name.qualified.rpartition("::")[0]
            is_open = outer in open_scopes or f"{name.qualified}" in open_names or \
                any(name.qualified.endswith(f"::{given}") for given in open_names)
            for found in uses.get(name.short, ()):
                scope = found[2].removesuffix("::")
                head, _, tail = scope.partition("::")
                scope = "::".join(part for part in (aliases.get(head, head), tail) if part)
                if scope and not name.qualified.endswith(f"{scope.removeprefix('dovetail::')}::{name.short}"):
                    continue
                is_found_by_arguments = name.kind == "function" and outer == "dovetail"
                if not scope and (name.short in locals_ or not is_open and not is_found_by_arguments):
                    continue
                if name.kind == "function":
                    call = re.compile(r"(<[^;()]*>)?\(").match(code, found.end())
                    if call and takes(name, arguments_at(code, call.end() - 1)) or not call and scope and code[found.end()] in ",)":
                        users[name.qualified].append(f"{folder}/{file.name}")
                        break
                elif not re.compile(r"\s*\(\)?\s*const\b").match(code, found.end()):
                    users[name.qualified].append(f"{folder}/{file.name}")
                    break
    return users


# What functions lack

def called_in_documents():
    """The words that the documents call as functions."""
    text = "".join(file.read_text() for file in (ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "docs/tutorials").glob("*.md"))
                   if file.exists())
    return set(re.findall(r"(?<![.\w>])(\w+)(?:<[\w, ]*>)?\(", text))


def faults_of_functions(library, meaning_of):
    """Free functions with a parameter of which nothing is known but its name; and, of those that users call, what has no
    \\param, and errors and complexity that are not told."""
    documented = called_in_documents()
    for name in library.names.values():
        if name.kind != "function":
            continue
        said = said_of_parameters(name)
        is_main = (name.short in documented or MAIN.fullmatch(name.short)) and not name.header().removeprefix("dovetail/").startswith(WITHOUT_OWN_CONTRACT)
        for parameter in dict.fromkeys(p for element in name.elements for p, _, _, _ in parameters_of(element)):
            if not parameter:
                continue
            if is_main and parameter not in said:
                yield f"{name.place()}: {name.qualified} is to be called, and has no \\param {parameter}"
            elif not meaning_of(name, parameter):
                yield f"{name.place()}: {name.qualified} does not say what {parameter} is"
        text = " ".join(plain(block) for block in name.blocks())
        if is_main and not ERRORS.search(text):
            yield f"{name.place()}: {name.qualified} is to be called, and does not say what it throws"
        if is_main and not COMPLEXITY.search(text):
            yield f"{name.place()}: {name.qualified} is to be called, and does not say its complexity"

