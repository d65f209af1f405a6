# cmake -DJSON=phantom.json -P phantom_options.cmake: prints the options of `tidemark-cli segment` that a
# phantom comes with. In CMake's language because CMake is there wherever this is built.
file(READ ${JSON} json)

macro(value_of result key)
  string(JSON ${result} GET ${json} ${key})
endmacro()

macro(list_of result key count)
  set(${result} "")
  math(EXPR last "${count} - 1")
  foreach(index RANGE ${last})
    string(JSON item GET ${json} ${key} ${index})
    list(APPEND ${result} ${item})
  endforeach()
  list(JOIN ${result} "," ${result})
endmacro()

value_of(target target)
value_of(range range)
value_of(alpha alpha)
string(JSON threshold ERROR_VARIABLE without_threshold GET ${json} init_threshold)
if(without_threshold)
  list_of(seed seed 4)
  set(start "--seed=${seed}")
else()
  list_of(threshold init_threshold 2)
  set(start "--init-threshold=${threshold}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E echo
  "--target=${target} --range=${range} --alpha=${alpha} ${start}")
