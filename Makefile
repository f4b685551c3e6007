# make        build/retarget and build/libbespoke.so
# make build/bespoke  the program that dresses characters in GLB, glTF, VRM and OBJ files (docs/program.md)
# make demo   makes a sample, dresses two bodies in it and says what came out
# make gallery  dresses all bodies of the closet in all its garments (build/gallery/index.html, sheet.png, pairs.md) and
#             makes the paper's figures
# make figures  the paper's figures alone: build/gallery/figures; make figures FIGURES='layers stress' some of them;
#             PAIRS has the folders of real pairs for those that show such beside the closet's
# make wardrobe  dresses the pairs in WARDROBE, folders as in ../shared/rigs/ready: build/wardrobe/sheet.png, wardrobe.md
# make moments  six moments of dressed, animated files: build/moments/moments.png; MOMENTS='dressed.glb Walking_A' says which
# make install  the library, its header, and what CMake and pkg-config need, in PREFIX (/usr/local); make uninstall
#             removes them again. docs/packaging.md says what goes where. OpenVDB is inside the library, as in the folder
#             to ship, where its sources can be had; make install OPENVDB=system takes the system's
# make test   every test, and make lint
# make lint   format, clippy and rustdoc: a warning is an error
# make sanitize  the C programs under AddressSanitizer, UndefinedBehaviourSanitizer and valgrind
# make dist   the folder to ship and its archive (build/dist; docs/dist.md)
# make dist-windows  the same for Windows, built here (docs/windows.md)
# make dist-aarch64  the same for Linux on 64-bit Arm, built here; make test-aarch64 tries it under QEMU (docs/dist.md)
# make wheel  the Python package as a wheel, with the library of `make dist` (build/wheel; docs/python.md)
# make blender  the Blender extension, with the wheel inside (build/blender/extension; bindings/blender/README.md)
# make test-blender  its tests, in Blender as a Python module; BPY=5.0.1 takes another one than 4.5 LTS
# make test-blender-window  the same in the window of Blender 5.2, which is fetched from Debian's unstable suite (build/blender/window)
# make unity  the Unity package and its tarball (build/unity; bindings/unity/README.md)
# make godot  the add-on for Godot 4, with the library of `make dist` (build/godot-addon; bindings/godot/README.md)
# make test-ray  the script for Ray clusters (docs/batches.md) on a local one, which is fetched from PyPI (build/ray)
# make test-godot  its tests alone, in the engine, which is fetched from Debian's unstable suite (build/godot)
# make unreal  the Unreal plugin (build/unreal; bindings/unreal/README.md)
# make fuzz   the fuzz targets, FUZZ_SECONDS each (needs a nightly toolchain and cargo install cargo-fuzz)
# make pairs  dresses the real meshes in ../shared/assets (or BESPOKE_ASSETS) and prints a table
# make soak   dresses 300 random bodies and prints what became of them; make soak SEED=17 tells about one
# make bench  measures whole retargets and kernels; make bench BENCH='pipeline --tables pairs --tight' a part of that
# make header writes include/bespoke.h again from the sources
# make bindings  the same, and from it what the bindings repeat of it: enums, structs, calls and options of C#, C++ and
#             Python, the pins of the layout, and bindings/bespoke.json, which describes it all
# make python-environment  an interpreter for the tests of the Python package (build/python), from PyPI
# make docs   the texts, the reference of the C header and that of the Rust modules as a book: build/docs/index.html
#
# As root, `demo`, `gallery`, `figures`, `dist`, `docs` and `test` install what is missing with apt. Rust has to be there
# (https://rustup.rs).

CC = cc
CFLAGS = -O2 -g
C_FLAGS = -std=c99 -pedantic -Wall -Wextra -Werror -Iinclude $(CFLAGS)
C_SOURCES = $(wildcard examples_c/*.c)
C_HEADERS = $(wildcard examples_c/*.h) include/bespoke.h
# Where cargo puts what it builds.
CARGO_TARGET_DIR ?= target
BUILT = $(CARGO_TARGET_DIR)/release/libbespoke.$(SHARED)
SHARED = $(if $(filter Darwin,$(shell uname)),dylib,so)
# The name by which the loader looks for the library: it holds the version of the binary interface.
ABI = $(shell sed -n 's/^.define BESPOKE_ABI_VERSION //p' include/bespoke.h)
LOADED = libbespoke.$(if $(filter Darwin,$(shell uname)),$(ABI).dylib,so.$(ABI))
ORIGIN = $(if $(filter Darwin,$(shell uname)),@loader_path,$$ORIGIN)
SAMPLE = build/sample
# Real meshes, where they are at hand: more tests, and the table of `make pairs`.
ASSETS = $(or $(BESPOKE_ASSETS),../shared/assets)

# Where `install` puts what; packaging/install.sh has the defaults of what is empty here.
PREFIX ?= /usr/local
STRIP ?= strip
INSTALLER = DESTDIR='$(DESTDIR)' PREFIX='$(PREFIX)' BINDIR='$(BINDIR)' LIBDIR='$(LIBDIR)' \
	INCLUDEDIR='$(INCLUDEDIR)' DOCDIR='$(DOCDIR)' STRIP='$(STRIP)' sh packaging/install.sh
CARGO_SOURCES = src cpp_shim build.rs Cargo.toml Cargo.lock
# Of the library that is installed: inside it, as in the folder to ship, or the system's.
OPENVDB = inside

.PHONY: all
all: build/retarget build/bespoke-retarget

build:
	mkdir -p build

# cargo decides what is new; the copy keeps its date where nothing is. A library in use is replaced, not overwritten.
# build/fresh has the date since which no source has changed.
build/libbespoke.$(SHARED): FORCE | build
	touch build/asked
	cargo build --release --lib
	cmp -s $(BUILT) $@ || { cp $(BUILT) $@.new && mv $@.new $@; }
	ln -sf libbespoke.$(SHARED) build/$(LOADED)
	mv build/asked build/fresh

build/retarget: $(C_SOURCES) $(C_HEADERS) build/libbespoke.$(SHARED)
	$(CC) $(C_FLAGS) $(C_SOURCES) -o $@ -Lbuild -lbespoke -lm '-Wl,-rpath,$(ORIGIN)'

build/bespoke: FORCE dependencies | build
	cargo build --release -p bespoke-cli
	cp $(CARGO_TARGET_DIR)/release/bespoke $@.new && mv $@.new $@

# `retarget` as it is installed: it finds the library from where it will lie.
build/bespoke-retarget: $(C_SOURCES) $(C_HEADERS) build/libbespoke.$(SHARED) build/run-path
	$(CC) $(C_FLAGS) $(C_SOURCES) -o $@ -Lbuild -lbespoke -lm '-Wl,-rpath,$(ORIGIN)/'"$$(cat build/run-path)"

build/run-path: FORCE | build
	way=$$($(INSTALLER) run-path) && { [ "$$way" = "$$(cat $@ 2>/dev/null)" ] || printf '%s' "$$way" >$@; }

# cargo is not asked where no source is newer than what it built: root may have none, and is not to build.
.PHONY: install
install:
	$(MAKE) build/bespoke-retarget \
		$$([ -n "$$(find $(CARGO_SOURCES) -newer build/fresh 2>&1)" ] || echo '-o build/libbespoke.$(SHARED)')
	library=$$(sh packaging/library.sh '$(OPENVDB)' build/libbespoke.$(SHARED) $(CARGO_SOURCES)) && \
		$(INSTALLER) install "$$library" build/bespoke-retarget

.PHONY: uninstall
uninstall:
	$(INSTALLER) uninstall

# The folder to ship. It is made from Debian's sources; where they cannot be had, `test` says that it skips it.
VERSION = $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
ARCHIVE = $(SHIPPED).tar.gz
SHIPS = $(shell [ "$$(uname -sm)" = 'Linux x86_64' ] && command -v apt-get)
.PHONY: dist
dist: dependencies
	sh packaging/dist/dist.sh build/dist

# The folder for Windows, by MinGW. What cannot be had ends packaging/windows/dist.sh with 77, and `test` skips it.
WINDOWS = build/dist/bespoke-$(VERSION)-windows-x86_64
MINGW = x86_64-w64-mingw32-g++-posix llvm-dlltool zip
.PHONY: dist-windows
dist-windows: dependencies
	sh .ci/dependencies $(MINGW)
	sh packaging/windows/dist.sh build/dist build/windows

.PHONY: tested-windows
tested-windows: dependencies
	rm -rf $(WINDOWS)
	sh .ci/dependencies $(MINGW) wine cmake || \
		{ echo "skipped: the tests of the folder for Windows, for MinGW and Wine cannot be had"; exit 0; }; \
	sh packaging/windows/dist.sh build/dist build/windows || { ended=$$?; rm -rf $(WINDOWS); [ $$ended -eq 77 ] || exit $$ended; \
		echo "skipped: the tests of the folder for Windows, for Rust's standard library for it cannot be had"; }

# The folder for Linux on 64-bit Arm, by Debian's cross compiler. PAIRS: how many real pairs are dressed, for QEMU is slow.
AARCH64 = build/dist/bespoke-$(VERSION)-linux-aarch64
.PHONY: dist-aarch64
dist-aarch64: dependencies
	sh .ci/dependencies aarch64-linux-gnu-g++
	MACHINE=aarch64 sh packaging/dist/dist.sh build/dist

.PHONY: test-aarch64
test-aarch64: dist-aarch64 build/retarget
	sh .ci/dependencies qemu-aarch64
	BESPOKE_AARCH64=$(CURDIR)/$(AARCH64) BESPOKE_AARCH64_PAIRS=$(PAIRS) BESPOKE_RETARGET=$(CURDIR)/build/retarget \
		cargo test --release --test aarch64

# The Python package, with the library of the folder to ship.
SHIPPED = build/dist/bespoke-$(VERSION)-linux-x86_64
.PHONY: wheel
wheel: dist python-environment
	sh packaging/wheel/wheel.sh $(PYTHON)/bin/python $(SHIPPED) build/wheel

# The Blender extension. Blender as a Python module, which has the tool that packs it, is fetched once, for each version.
BPY = 4.5.15
BLENDER = build/blender/bpy-$(BPY)
.PHONY: blender
blender: wheel
	sh packaging/blender/environment.sh $(BLENDER) $(BPY)
	sh packaging/blender/pack.sh $(BLENDER) build/wheel build/blender/extension

.PHONY: test-blender
test-blender: wheel
	[ -f $(SAMPLE)/heavy/skin.txt ] || cargo run --release -p closet -- $(SAMPLE)
	sh tests/blender/test.sh build/wheel $(SAMPLE) $(BPY)

# The panel, Esc and undo, in a window that nobody sees. Not a part of `make test`: Blender is 350 MB to fetch.
.PHONY: test-blender-window
test-blender-window: wheel
	sh .ci/dependencies Xvfb xwd convert
	[ -f $(SAMPLE)/heavy/skin.txt ] || cargo run --release -p closet -- $(SAMPLE)
	sh tests/blender/window-test.sh build/wheel $(SAMPLE) $(BPY)

# The Unity package. The library for Windows is in it where there is one.
.PHONY: unity
unity: dist
	sh .ci/dependencies npm
	sh packaging/unity/pack.sh $(SHIPPED) $(WINDOWS) build/unity

# The Unreal plugin, in the same way.
.PHONY: unreal
unreal: dist
	sh packaging/unreal/pack.sh $(SHIPPED) $(WINDOWS) build/unreal

# The TBB that hosts bring along.
.PHONY: host-tbb
host-tbb: dependencies
	sh .ci/dependencies pip3
	sh tests/dist/tbb.sh build/tbb

# An interpreter with what the tests of the Python package try it with; none where PyPI cannot be reached.
PYTHON = build/python
.PHONY: python-environment
python-environment: dependencies
	sh .ci/dependencies python3-venv
	sh tests/python/environment.sh $(PYTHON) || \
		{ rm -rf $(PYTHON); echo "skipped: the tests of the Python package, for NumPy cannot be had"; }

# The add-on for Godot. Its tests take the library of the folder to ship where there is one.
.PHONY: godot
godot: dist
	sh bindings/godot/build.sh $(SHIPPED)/lib/libbespoke.so build/godot-addon

.PHONY: godot-environment
godot-environment: dependencies | build
	[ -f $(SHIPPED)/lib/libbespoke.so ] || $(MAKE) build/libbespoke.$(SHARED)
	sh tests/godot/environment.sh "$$(ls $(SHIPPED)/lib/libbespoke.so build/libbespoke.$(SHARED) 2>/dev/null | head -n 1)" build

# What the tests in hosts take, which is fetched while other things are built. It is asked for again where it is used, which says
# what cannot be had.
.PHONY: hosts-fetched
hosts-fetched: | build
	-sh tests/godot/engine.sh build/godot >/dev/null 2>&1
	-$(if $(SHIPS),[ ! -d $(PYTHON) ] || sh packaging/blender/environment.sh $(BLENDER) $(BPY) >/dev/null 2>&1)

.PHONY: test-godot
test-godot: godot-environment
	cargo test --release --test godot

# Too large for every run of the tests: 400 MB.
.PHONY: test-ray
test-ray: dependencies
	[ -x build/ray/bin/ray ] || { python3 -m venv build/ray && build/ray/bin/pip --quiet install ray numpy; }
	BESPOKE_RAY='$(CURDIR)/build/ray/bin/python' cargo test --release -p bespoke-cli --test dress -- --nocapture ray

.PHONY: dependencies
dependencies:
	sh .ci/dependencies

.PHONY: demo
demo: dependencies
	$(MAKE) build/retarget
	cargo run --release -p closet -- $(SAMPLE)
	sh examples_c/demo.sh build/retarget $(SAMPLE)

# GALLERY: options of the program, such as '--avatars child,giant --keep'. Pictures are made of what there is, also where
# a pair has failed or a figure does not show what it claims.
WEB = tools/gallery/web
RENDER = node $(WEB)/render.mjs
.PHONY: gallery
gallery: painter
	cargo run --release -p gallery -- --out build/gallery $(GALLERY); ended=$$?; \
	[ $$ended -le 1 ] || exit $$ended; \
	$(RENDER) build/gallery/sheet.json build/gallery/sheet.png --page build/gallery/index.html || exit 2; \
	$(MAKE) figures && exit $$ended

# WARDROBE: the folders of the pairs.
.PHONY: wardrobe
wardrobe: painter
	cargo run --release -p gallery --bin wardrobe -- $(or $(WARDROBE),$(wildcard ../shared/rigs/ready/*)) \
		--out build/wardrobe; ended=$$?; [ $$ended -le 1 ] || exit $$ended; \
	$(RENDER) build/wardrobe/sheet.json build/wardrobe/sheet.png && exit $$ended

# MOMENTS: files that `bespoke dress` has written, each with the name of an animation in it.
.PHONY: moments
moments: painter
	cargo run --release -p gallery --bin moments -- $(MOMENTS) --out build/moments
	$(RENDER) build/moments/moments.json build/moments/moments.png

# PAIRS: folders of real pairs, for figures that have such.
PAIRS ?= $(wildcard ../shared/rigs/ready/*)
.PHONY: figures
figures: painter
	cargo run --release -p figures -- --out build/gallery/figures $(addprefix --pair ,$(PAIRS)) $(FIGURES); ended=$$?; \
	[ $$ended -le 1 ] || exit $$ended; \
	for sheet in build/gallery/figures/*.json; do $(RENDER) $$sheet $${sheet%.json}.png || exit 2; done; \
	exit $$ended

# What draws the pictures.
.PHONY: painter
painter: dependencies
	sh .ci/dependencies chromium node npm
	$(MAKE) $(WEB)/node_modules/.package-lock.json

$(WEB)/node_modules/.package-lock.json: $(WEB)/package.json $(WEB)/package-lock.json
	cd $(WEB) && npm ci --ignore-scripts --no-audit --no-fund

# With the settings of the tests' build, so that they share what build scripts make. Links and words of the texts are
# tests of their own (tools/testing/tests/links).
.PHONY: lint
lint: dependencies
	@cargo fmt --version >/dev/null 2>&1 || echo "skipped: the format, for there is no rustfmt (rustup component add rustfmt)"
	! cargo fmt --version >/dev/null 2>&1 || cargo fmt --all --check
	@cargo clippy --version >/dev/null 2>&1 || echo "skipped: clippy, which is not there (rustup component add clippy)"
	! cargo clippy --version >/dev/null 2>&1 || cargo clippy --release --workspace --all-targets -- -D warnings
	sh bindings/godot/lint.sh
	RUSTDOCFLAGS='-D warnings' cargo doc --release --workspace --lib --no-deps

# What the tests try that is neither the workspace's nor needed by them all. apt is through before anything here asks it where
# its mirror is.
.PHONY: tested-apart
tested-apart: dependencies
	sh .ci/dependencies node npm || true
	$(if $(SHIPS),sh .ci/dependencies $(MINGW) wine || true)
	$(MAKE) python-environment
	$(MAKE) hosts-fetched & fetched=$$!; \
	$(if $(SHIPS),$(MAKE) dist host-tbb tested-windows,true); ended=$$?; wait $$fetched; exit $$ended

# The header is compared, and compiled as C99 and C++17, by the tests of the C API. They are built like the library,
# so that nothing is built twice. What is shipped is made meanwhile: each of the two has long parts for one core. So have the
# tests, beside which Blender's run and write into a file.
.PHONY: test
test: dependencies
	sh .ci/dependencies cmake pkg-config clang mcs mono $(if $(SHIPS),pip3)
	$(MAKE) tested-apart & apart=$$!; \
	$(MAKE) lint build/retarget && cargo test --release --workspace --no-run; built=$$?; \
	[ $$built -eq 0 ] || { kill $$apart 2>/dev/null; exit $$built; }; wait $$apart
	$(if $(SHIPS),[ ! -d $(PYTHON) ] || sh packaging/wheel/wheel.sh $(PYTHON)/bin/python $(SHIPPED) build/wheel)
	$(MAKE) godot-environment
	$(if $(SHIPS),[ ! -d $(PYTHON) ] || sh packaging/blender/environment.sh $(BLENDER) $(BPY) || [ $$? -eq 3 ])
	[ -f $(SAMPLE)/heavy/skin.txt ] || cargo run --release -p closet -- $(SAMPLE)
	$(if $(SHIPS),[ ! -d $(PYTHON) ] || sh tests/blender/test.sh build/wheel $(SAMPLE) $(BPY) >build/blender-tests.txt 2>&1 & blender=$$!,blender=); \
	[ ! -d $(BLENDER) ] || export BESPOKE_BLENDER=$(CURDIR)/$(BLENDER)/bin/python; \
	[ ! -d $(WINDOWS) ] || export BESPOKE_WINDOWS=$(CURDIR)/$(WINDOWS); BESPOKE_RETARGET=$(CURDIR)/build/retarget \
		$(if $(SHIPS),BESPOKE_WHEEL=$(CURDIR)/build/wheel BESPOKE_DIST=$(CURDIR)/$(ARCHIVE) BESPOKE_TBB=$(CURDIR)/build/tbb) cargo test --release --workspace; \
	tested=$$?; [ -z "$$blender" ] || { wait $$blender || tested=$$?; cat build/blender-tests.txt; }; exit $$tested
	$(MAKE) install DESTDIR='$(CURDIR)/build/stage'
	$(MAKE) uninstall DESTDIR='$(CURDIR)/build/stage'
	[ -z "$$(find build/stage ! -type d)" ]
	@[ -d $(PYTHON) ] || echo "skipped: the tests of the Python package and of the Blender extension, for there is no NumPy"
	$(if $(SHIPS),,@echo "skipped: the tests of the Blender extension, for there is no wheel for this system")
	@[ -d $(WINDOWS) ] || echo "skipped: the tests of the folder for Windows, for it was not made"
	@[ -d "$(ASSETS)" ] || echo "skipped: all tests on real meshes, for there are none in $(ASSETS) (set BESPOKE_ASSETS)"

.PHONY: sanitize
sanitize: dependencies
	sh .ci/dependencies valgrind
	$(MAKE) build/libbespoke.$(SHARED)
	[ -d $(SAMPLE) ] || cargo run --release -p closet -- $(SAMPLE)
	CC=$(CC) sh tests/c/sanitize.sh build $(SAMPLE)

# What is found new goes to build/fuzz, and what fails to tests/fuzz/artifacts. A nightly build of its own, so the first
# run takes minutes longer.
FUZZ_SECONDS = 60
FUZZ_TARGETS = calls buffers meshes files
.PHONY: fuzz
fuzz: dependencies
	for target in $(FUZZ_TARGETS); do \
		mkdir -p build/fuzz/$$target && \
		cargo +nightly fuzz run --fuzz-dir tests/fuzz $$target build/fuzz/$$target tests/fuzz/corpus/$$target -- \
			-max_total_time=$(FUZZ_SECONDS) -max_len=$$([ $$target = files ] && echo 4096 || echo 600) -timeout=120 -rss_limit_mb=4096 || exit 1; \
	done

.PHONY: pairs
pairs: build/retarget
	sh examples_c/pairs.sh build/retarget "$(ASSETS)" build/pairs --threads 2

# COUNT and FIRST: how many, from which seed on.
.PHONY: soak
soak:
	cargo run --release -p soak -- $(if $(SEED),--seed $(SEED),--count $(or $(COUNT),300) --first $(or $(FIRST),1))

# BENCH: pipeline or kernels, and its options (pipeline --help lists them); both without.
.PHONY: bench
bench: dependencies
	$(if $(BENCH),,cargo bench -p bench --bench kernels)
	cargo bench -p bench --bench $(or $(firstword $(BENCH)),pipeline) -- $(wordlist 2,$(words $(BENCH)),$(BENCH))

.PHONY: bindings
bindings: header
	cargo run --release -p bespoke-bindgen

.PHONY: header
header:
	BESPOKE_UPDATE_HEADER=1 cargo test --release --test capi header::committed

.PHONY: docs
docs: dependencies
	sh .ci/dependencies mkdocs doxygen
	sh packaging/book/build.sh

.PHONY: clean
clean:
	rm -rf build
	cargo clean

.PHONY: FORCE
FORCE:
