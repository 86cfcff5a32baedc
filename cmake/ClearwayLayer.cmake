# clearway_layer(<name> SOURCES ... PUBLIC ... PRIVATE ...): one static library `clearway_<name>` (alias clearway::<name>)
# of src/<name>, with public headers in include/clearway/<name>.
function(clearway_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(clearway_${name} STATIC ${ARG_SOURCES})
  add_library(clearway::${name} ALIAS clearway_${name})
  set_target_properties(clearway_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(clearway_${name} PUBLIC cxx_std_20)
  target_include_directories(clearway_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(clearway_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE}
    $<BUILD_INTERFACE:clearway_warnings>)
  install(TARGETS clearway_${name} EXPORT clearwayTargets)
endfunction()

# clearway_test(<name> SOURCES ... LIBRARIES ...): a GoogleTest program, each of its tests known to ctest.
function(clearway_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE CLEARWAY_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} clearway_warnings GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60)
endfunction()

# Our warnings; and bit-equal arithmetic on every compiler (docs/architecture.md, Determinism).
add_library(clearway_warnings INTERFACE)
target_compile_options(clearway_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off
  # GCC 12 reports overlaps inside std::string that cannot be, https://gcc.gnu.org/PR105651.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${CLEARWAY_WERROR}>:-Werror>)
