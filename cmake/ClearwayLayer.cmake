# Precompiled headers, which halve the time of a build: what nearly every source of a layer, and every test, includes.
add_library(clearway_pch OBJECT ${CMAKE_CURRENT_LIST_DIR}/pch.cc)
target_link_libraries(clearway_pch PRIVATE Eigen3::Eigen absl::statusor absl::strings absl::flat_hash_map
  absl::flat_hash_set clearway_warnings)
target_precompile_headers(clearway_pch PRIVATE <Eigen/Core> <Eigen/Geometry> <functional> <map> <memory>
  <optional> <string> <vector> <absl/container/flat_hash_map.h> <absl/container/flat_hash_set.h>
  <absl/status/statusor.h> <absl/strings/str_cat.h>)
if(CLEARWAY_BUILD_TESTS)
  add_library(clearway_test_pch OBJECT ${CMAKE_CURRENT_LIST_DIR}/pch.cc)
  target_link_libraries(clearway_test_pch PRIVATE Eigen3::Eigen absl::statusor clearway_warnings GTest::gmock
    GTest::gtest_main)
  target_precompile_headers(clearway_test_pch PRIVATE <Eigen/Core> <Eigen/Geometry> <gmock/gmock.h> <gtest/gtest.h>
    <map> <memory> <optional> <random> <set> <string> <vector> <absl/status/statusor.h>)
endif()

# clearway_layer(<name> SOURCES ... PUBLIC ... PRIVATE ... [OWN_PCH]): one static library `clearway_<name>` (alias
# clearway::<name>) of src/<name>, with public headers in include/clearway/<name>. OWN_PCH: the caller precompiles its own
# headers.
function(clearway_layer name)
  cmake_parse_arguments(ARG "OWN_PCH" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(clearway_${name} STATIC ${ARG_SOURCES})
  add_library(clearway::${name} ALIAS clearway_${name})
  set_target_properties(clearway_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(clearway_${name} PUBLIC cxx_std_20)
  target_include_directories(clearway_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(clearway_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE}
    $<BUILD_INTERFACE:clearway_warnings>)
  if(NOT ARG_OWN_PCH)
    target_precompile_headers(clearway_${name} REUSE_FROM clearway_pch)
  endif()
  install(TARGETS clearway_${name} EXPORT clearwayTargets)
endfunction()

# clearway_test(<name> SOURCES ... LIBRARIES ... [OVER_GRPC]): a GoogleTest program, each of its tests known to ctest, under
# the label `grpc` if it calls a server: the thread sanitizer cannot follow those, as gRPC was built without it.
function(clearway_test name)
  cmake_parse_arguments(ARG "OVER_GRPC" "" "SOURCES;LIBRARIES" ${ARGN})
  set(label local)
  if(ARG_OVER_GRPC)
    set(label grpc)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${name} PRIVATE CLEARWAY_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} clearway_warnings GTest::gmock GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM clearway_test_pch)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label})
endfunction()

# Our warnings; and bit-equal arithmetic on every compiler (docs/architecture.md, Determinism).
add_library(clearway_warnings INTERFACE)
target_compile_options(clearway_warnings INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off
  # GCC 12 reports overlaps inside std::string that cannot be, https://gcc.gnu.org/PR105651.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${CLEARWAY_WERROR}>:-Werror>)
