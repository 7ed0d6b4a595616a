# `docs`: the API reference of include/tamis as HTML, by Doxygen where that is installed. A public name without a comment
# fails. What every policy of a role must have is documented once, in cmake/docs/members.awk.
find_program(TAMIS_DOXYGEN doxygen)
mark_as_advanced(TAMIS_DOXYGEN)
if(TAMIS_DOXYGEN)
    set(tamis_docs ${PROJECT_BINARY_DIR}/docs)
    configure_file(cmake/docs/Doxyfile.in ${tamis_docs}/Doxyfile @ONLY)
    add_custom_target(docs
        COMMAND ${TAMIS_DOXYGEN} ${tamis_docs}/Doxyfile
        COMMAND ${CMAKE_COMMAND} -E echo "The reference: ${tamis_docs}/html/index.html"
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        COMMENT "API reference"
        VERBATIM)
endif()
