# How the parts of the project see each other.
#
# Files include each other by their path from the project's root ("shared/model/bending_model.h"). Each part gets a
# directory of its own in the build tree that holds nothing but a link to the part's folder, and a target sees the
# directories of the parts it links, no others. So boundary_integral/ cannot include phasefield/, and neither can include
# cli/. A folder inside a part ("phasefield/fem") can be a part itself; the part around it then links single headers.

get_filename_component(ENDOFLOW_ROOT ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)

# endoflow_part_directory(PART result [headers…]): the directory through which PART is seen, whole or these headers alone.
function(endoflow_part_directory part result)
  string(REPLACE "/" "-" name ${part})
  set(root ${CMAKE_BINARY_DIR}/include/${name})
  set(linked ${part})
  set(headers ${ARGN})
  list(TRANSFORM headers PREPEND ${part}/)
  if(headers)
    set(linked ${headers})
  endif()
  foreach(entry IN LISTS linked)
    get_filename_component(folder ${root}/${entry} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    if(NOT EXISTS ${root}/${entry})
      file(CREATE_LINK ${ENDOFLOW_ROOT}/${entry} ${root}/${entry} SYMBOLIC)
    endif()
  endforeach()
  set(${result} ${root} PARENT_SCOPE)
endfunction()

add_library(endoflow_warnings INTERFACE)
target_compile_options(endoflow_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
if(ENDOFLOW_WERROR)
  target_compile_options(endoflow_warnings INTERFACE -Werror)
endif()
if(ENDOFLOW_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Clang's -Wall has it, but clang-tidy does not see it in files that others include. 2: GCC sees it there.
  target_compile_options(endoflow_warnings INTERFACE -Wunused-const-variable=2)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105651: "string" + temporary string is reported as an overlapping copy.
  target_compile_options(endoflow_warnings INTERFACE -Wno-restrict)
endif()

add_library(endoflow_sanitizers INTERFACE)
if(ENDOFLOW_SANITIZE)
  target_compile_options(endoflow_sanitizers INTERFACE -fsanitize=${ENDOFLOW_SANITIZE} -fno-sanitize-recover=all
                                                       -fno-omit-frame-pointer)
  target_link_options(endoflow_sanitizers INTERFACE -fsanitize=${ENDOFLOW_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bug 105562: with sanitizers std::function in <regex>, which Catch2 includes, seems uninitialized.
    target_compile_options(endoflow_sanitizers INTERFACE -Wno-maybe-uninitialized)
  endif()
elseif(ENDOFLOW_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "libFuzzer comes with Clang: configure with -DCMAKE_CXX_COMPILER=clang++, or without "
                        "-DENDOFLOW_FUZZ=ON")
  endif()
  target_compile_options(endoflow_sanitizers INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                                                       -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(endoflow_sanitizers INTERFACE -fsanitize=address,undefined)
endif()

# endoflow_add_part(TARGET PART sources… [HEADERS headers…]) makes a static library of one part; its users see PART's
# headers, or those named alone.
function(endoflow_add_part target part)
  cmake_parse_arguments(part "" "" "HEADERS" ${ARGN})
  endoflow_part_directory(${part} root ${part_HEADERS})
  add_library(${target} STATIC ${part_UNPARSED_ARGUMENTS})
  target_include_directories(${target} PUBLIC ${root})
  target_link_libraries(${target} PRIVATE endoflow_warnings PUBLIC endoflow_sanitizers)
endfunction()
