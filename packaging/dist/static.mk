# OpenVDB and oneTBB as static libraries with hidden symbols, only what the shim needs of them:
#
#   make -f static.mk -j SOURCES=folder OUT=folder [CROSS=prefix]
#
# SOURCES is what sources.sh left. OUT gets include and lib, as build.rs takes them in BESPOKE_STATIC_OPENVDB. CROSS is the
# prefix of the tools where it is for another system: x86_64-w64-mingw32- for Windows, aarch64-linux-gnu- for Arm.
#
# No compression, no delayed loading, no logging, and half floats of OpenVDB's own: so that nothing but these two and
# headers of Boost is linked in.

CROSS =
MINGW = $(findstring mingw,$(CROSS))
# With the threads of C++11, where MinGW has a choice.
CXX = $(if $(CROSS),$(CROSS)g++$(if $(MINGW),-posix),c++)
AR = $(CROSS)ar
# Paths of this machine stay out of what is built. A product and a sum are rounded each, also where the processor could do
# both at once, as Arm's can and GCC would: the same bits everywhere.
FLAGS = -std=c++17 -O2 -DNDEBUG -ffp-contract=off -fPIC -fvisibility=hidden -fvisibility-inlines-hidden -ffunction-sections \
	-fdata-sections -ffile-prefix-map=$(abspath $(OUT))/include=include -ffile-prefix-map=$(abspath $(SOURCES))=.

VDB = $(SOURCES)/openvdb/openvdb/openvdb
TBB = $(SOURCES)/onetbb
# What the voxeliser reaches by name or through tables of virtual functions. Nothing is read or written by OpenVDB.
VDB_NAMES = Grid MetaMap Metadata io/Archive io/Compression io/DelayedLoadMetadata io/GridDescriptor math/Half \
	math/Maps math/Proximity math/Transform points/StreamCompression util/Formats util/Util
VDB_OBJECTS = $(VDB_NAMES:%=$(OUT)/objects/openvdb/%.o)
TBB_OBJECTS = $(patsubst $(TBB)/src/tbb/%.cpp,$(OUT)/objects/tbb/%.o,$(wildcard $(TBB)/src/tbb/*.cpp))
# oneTBB opens other libraries (allocator, binding to processors, tracing) by their names, and would get those of the
# host's TBB: switched off. Without the second line it would still take the allocator and the binding of a host that has
# them in memory, and so die with them.
TBB_FLAGS = -D__TBB_BUILD -D__TBB_SOURCE_DIRECTLY_INCLUDED=1 -D__TBB_DYNAMIC_LOAD_ENABLED=0 \
	-D__TBB_WEAK_SYMBOLS_PRESENT=0 -flifetime-dse=1
ifneq ($(filter x86_64%,$(or $(CROSS),$(shell uname -m))),)
TBB_FLAGS += -mrtm -mwaitpkg
endif
# For Windows the names of OpenVDB are marked as those of a library to load, if it is not told otherwise, and those of both
# would be exported by whatever links them: the marks are taken out. No name is kept back there unless it is marked.
ifneq ($(MINGW),)
FLAGS += -DOPENVDB_STATICLIB
UNMARK = $(CROSS)objcopy --remove-section .drectve $@
endif
ifneq ($(CROSS),)
# The system's headers are not for this compiler; those of Boost are.
BOOST = ln -s /usr/include/boost $(OUT)/include/boost
endif

.PHONY: all
all: $(OUT)/lib/libopenvdb.a $(OUT)/lib/libtbb.a

# The headers as they are installed. In version.h a number of the version is filled in; a setting that is off is an
# undefined macro, a list of instantiations that are kept ready is empty.
part = $(shell sed -n 's/^set(OpenVDB_$(1)_VERSION \([0-9]*\))/\1/p' $(SOURCES)/openvdb/CMakeLists.txt)
MAJOR := $(call part,MAJOR)
MINOR := $(call part,MINOR)
PATCH := $(call part,PATCH)
HEADERS = $(OUT)/include/.complete
$(HEADERS): $(MAKEFILE_LIST) $(SOURCES)/openvdb/.unpacked $(SOURCES)/onetbb/.unpacked
	rm -rf $(OUT)/include
	mkdir -p $(OUT)/include
	cd $(SOURCES)/openvdb/openvdb && tar -cf - $$(find openvdb -name '*.h') | tar -xf - -C $(abspath $(OUT))/include
	cp -r $(TBB)/include/. $(OUT)/include/
	sed -e 's/$${OpenVDB_MAJOR_VERSION}/$(MAJOR)/; s/$${OpenVDB_MINOR_VERSION}/$(MINOR)/' \
		-e 's/$${OpenVDB_PATCH_VERSION}/$(PATCH)/' \
		-e 's/$${OPENVDB_ABI_VERSION_NUMBER}/$(MAJOR)/; s/$${OPENVDB_NAMESPACE_SUFFIX}//' \
		-e "s/\$${OPENVDB_PACKED_VERSION}/$$(($(MAJOR) << 24 | $(MINOR) << 16 | $(PATCH)))/" \
		-e 's/^#cmakedefine .*//; s/@OPENVDB_[A-Z0-9_]*@//' $(VDB)/version.h.in >$(OUT)/include/openvdb/version.h
	! grep -E '[$$]\{|cmakedefine' $(OUT)/include/openvdb/version.h
	$(BOOST)
	touch $@

$(OUT)/objects/openvdb/%.o: $(VDB)/%.cc $(HEADERS)
	@mkdir -p $(@D)
	$(CXX) $(FLAGS) -DOPENVDB_PRIVATE -I$(OUT)/include -I$(OUT)/include/openvdb -c $< -o $@
	@$(UNMARK)

$(OUT)/objects/tbb/%.o: $(TBB)/src/tbb/%.cpp $(HEADERS)
	@mkdir -p $(@D)
	$(CXX) $(FLAGS) $(TBB_FLAGS) -I$(OUT)/include -c $< -o $@
	@$(UNMARK)

$(OUT)/lib/libopenvdb.a: $(VDB_OBJECTS)
$(OUT)/lib/libtbb.a: $(TBB_OBJECTS)
$(OUT)/lib/%.a:
	@mkdir -p $(@D)
	rm -f $@
	$(AR) -rcsD $@ $^
