# What cmake/modules.txt says, for scripts that source this in the folder of the project:
#   modules          the modules in their order
#   includes_of      module -> what it may include: itself, and what the modules that it names may include
#   layers_of        module -> how many layers it has
#   find_place FILE  sets module, layer (from 1) and component (what it needs, or nothing) of a path under include/dovetail;
#                    fails when it is in no module
#   is_system NAME   whether a header <NAME> is there with a compiler

modules=()
system_headers=
declare -A includes_of=() layers_of=() module_of_path=() layer_of_path=() component_of_path=()
while IFS='|' read -r kind name words; do
  kind=${kind// /} name=${name// /}
  [[ $kind && $kind != '#'* ]] || continue
  case $kind in
    has)
      [[ ${layers_of[$name]:-} ]] || { modules+=("$name"); includes_of[$name]=" $name "; }
      layers_of[$name]=$((${layers_of[$name]:-0} + 1))
      for path in $words; do
        [[ ! ${module_of_path[$path]:-} ]] || { echo "cmake/modules.txt: $path is there twice" >&2; exit 1; }
        module_of_path[$path]=$name
        layer_of_path[$path]=${layers_of[$name]}
      done ;;
    includes)
      for other in $words; do
        [[ $other != "$name" && ${layers_of[$other]:-} ]] ||
          { echo "cmake/modules.txt: $name includes $other, which does not stand before it" >&2; exit 1; }
        includes_of[$name]+="${includes_of[$other]# }"
      done ;;
    needs) for path in $words; do component_of_path[$path]=$name; done ;;
    system) system_headers=" ${words# } " ;;
    *) echo "cmake/modules.txt: what is '$kind'?" >&2; exit 1 ;;
  esac
done <cmake/modules.txt

find_place() {
  local path=${1%.[hi]pp}
  module='' layer='' component=''
  while :; do
    [[ $component ]] || component=${component_of_path[$path]:-}
    [[ $module ]] || { module=${module_of_path[$path]:-} layer=${layer_of_path[$path]:-}; }
    [[ $path == */* ]] || break
    path=${path%/*}
  done
  [[ $module ]]
}

is_system() {
  [[ $1 =~ ^[a-z_0-9]+$ || $system_headers == *" ${1%%/*} "* ]]
}
