# Manual page and completions of shells, made by the program from its own options and parameters.
set(ENDOFLOW_MANUAL_DIR ${CMAKE_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${ENDOFLOW_MANUAL_DIR})
file(GLOB generator CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tools/manual/*.py ${CMAKE_SOURCE_DIR}/comparisons/commands/*.py)
set(described endoflow endoflow-boundary-integral endoflow-modes endoflow-statics)
if(ENDOFLOW_PHASEFIELD)
  list(APPEND described endoflow-phase-field)
endif()
list(TRANSFORM described REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE described_files)
add_custom_command(
  OUTPUT ${ENDOFLOW_MANUAL_DIR}/endoflow.1 ${ENDOFLOW_MANUAL_DIR}/endoflow.bash ${ENDOFLOW_MANUAL_DIR}/_endoflow
         ${ENDOFLOW_MANUAL_DIR}/endoflow.fish
  COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${ENDOFLOW_PYTHON} ${CMAKE_SOURCE_DIR}/tools/manual/make_manual.py
          $<TARGET_FILE:endoflow> ${CMAKE_SOURCE_DIR}/cases ${ENDOFLOW_MANUAL_DIR}
  DEPENDS ${described} ${described_files} ${generator}
  COMMENT "Manual page and completions")
add_custom_target(manual ALL DEPENDS ${ENDOFLOW_MANUAL_DIR}/endoflow.1)
add_dependencies(programs manual)
