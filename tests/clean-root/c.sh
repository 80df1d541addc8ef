# The C library by CMake, from the release archive alone. The program is that of its README.
set -eu
mkdir /home/c
cd /home/c
tar -xf /artefacts/muslin-*-x86_64-unknown-linux-gnu.tar.gz
awk '/^```c$/ { inside = 1; next } /^```/ { inside = 0 } inside' muslin-*/README.md > main.c
cat > CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.13)
project(sheet C)
find_package(Muslin REQUIRED)
add_executable(sheet main.c)
target_link_libraries(sheet PRIVATE Muslin::muslin)
END
cmake -B build -DCMAKE_PREFIX_PATH="$PWD"
cmake --build build
./build/sheet | tee output.txt
grep -q '^1600 vertices$' output.txt
echo "first frame: C by CMake, $(grep -c . CMakeLists.txt) lines of CMake, $(grep -c . main.c) of C"
