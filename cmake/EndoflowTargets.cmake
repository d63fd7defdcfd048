# How the parts of the project see each other.
#
# Files include each other by their path from the project's root ("shared/model/bending_model.h"). Each part gets a
# directory of its own in the build tree that holds nothing but a link to the part, and a target sees the directories
# of the parts it links, no others. So boundary_integral/ cannot include phasefield/, and neither can include cli/.

get_filename_component(ENDOFLOW_ROOT ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)

function(endoflow_part_directory part result)
  set(root ${CMAKE_BINARY_DIR}/include/${part})
  file(MAKE_DIRECTORY ${root})
  if(NOT EXISTS ${root}/${part})
    file(CREATE_LINK ${ENDOFLOW_ROOT}/${part} ${root}/${part} SYMBOLIC)
  endif()
  set(${result} ${root} PARENT_SCOPE)
endfunction()

add_library(endoflow_warnings INTERFACE)
target_compile_options(endoflow_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
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

# endoflow_add_part(TARGET PART sources… ) makes a static library of one part; its users see PART's headers.
function(endoflow_add_part target part)
  endoflow_part_directory(${part} root)
  add_library(${target} STATIC ${ARGN})
  target_include_directories(${target} PUBLIC ${root})
  target_link_libraries(${target} PRIVATE endoflow_warnings PUBLIC endoflow_sanitizers)
endfunction()
