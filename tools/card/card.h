// The card: its words, its memory, its clock. Without nvcc, the same on the processor, so that searches can be checked there.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#ifdef __CUDACC__

#define ON_CARD __device__ __forceinline__
#define ANYWHERE __host__ __device__ __forceinline__
#define KERNEL __global__

inline void must(cudaError_t outcome, const char* what) {
    if (outcome != cudaSuccess) {
        std::fprintf(stderr, "knn: %s: %s\n", what, cudaGetErrorString(outcome));
        std::exit(1);
    }
}

// A copy of numbers in the card's memory; lives as long as the program.
template <class T>
T* to_card(const std::vector<T>& numbers) {
    T* there = nullptr;
    must(cudaMalloc(&there, std::max<size_t>(1, numbers.size()) * sizeof(T)), "memory of the card");
    must(cudaMemcpy(there, numbers.data(), numbers.size() * sizeof(T), cudaMemcpyHostToDevice), "copy to the card");
    return there;
}

template <class T>
std::vector<T> from_card(const T* there, size_t count) {
    std::vector<T> numbers(count);
    must(cudaMemcpy(numbers.data(), there, count * sizeof(T), cudaMemcpyDeviceToHost), "copy from the card");
    return numbers;
}

template <class T>
void fill_on_card(T* there, size_t count, int byte) {
    must(cudaMemset(there, byte, count * sizeof(T)), "memory of the card");
}

// Says what a thread block may use of the memory that is shared memory and first-level cache in one.
template <class Kernel>
void prepare(Kernel kernel, size_t shared) {
    const int carveout = shared > 0 ? cudaSharedmemCarveoutMaxShared : cudaSharedmemCarveoutMaxL1;
    must(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, int(shared)), "shared memory");
    must(cudaFuncSetAttribute(kernel, cudaFuncAttributePreferredSharedMemoryCarveout, carveout), "carveout");
}

// Seconds of one launch, by the card's own events.
template <class Kernel, class... Arguments>
double timed(Kernel kernel, unsigned blocks, unsigned threads, size_t shared, Arguments... arguments) {
    cudaEvent_t before, after;
    must(cudaEventCreate(&before), "event");
    must(cudaEventCreate(&after), "event");
    must(cudaEventRecord(before), "event");
    kernel<<<blocks, threads, shared>>>(arguments...);
    must(cudaGetLastError(), "launch");
    must(cudaEventRecord(after), "event");
    must(cudaEventSynchronize(after), "kernel");
    float milliseconds = 0;
    must(cudaEventElapsedTime(&milliseconds, before, after), "event");
    must(cudaEventDestroy(before), "event");
    must(cudaEventDestroy(after), "event");
    return milliseconds / 1e3;
}

// Registers and bytes of local memory of a thread, and threads in flight on the whole card.
struct Occupancy {
    int registers, local_bytes, resident;
};

template <class Kernel>
Occupancy occupancy(Kernel kernel, unsigned threads, size_t shared) {
    cudaFuncAttributes attributes;
    cudaDeviceProp card;
    int blocks = 0;
    must(cudaFuncGetAttributes(&attributes, kernel), "attributes");
    must(cudaGetDeviceProperties(&card, 0), "properties");
    must(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, int(threads), shared), "occupancy");
    return {attributes.numRegs, int(attributes.localSizeBytes), blocks * int(threads) * card.multiProcessorCount};
}

// What stands about the card in each result, as fields of JSON.
inline std::string about_card() {
    cudaDeviceProp card;
    int driver = 0, runtime = 0;
    must(cudaGetDeviceProperties(&card, 0), "properties");
    must(cudaDriverGetVersion(&driver), "driver");
    must(cudaRuntimeGetVersion(&runtime), "runtime");
    char text[400];
    std::snprintf(text, sizeof text, "\"card\": \"%s\", \"cuda_driver\": %d, \"cuda_runtime\": %d, \"multiprocessors\": %d, \"l2_bytes\": %d",
                  card.name, driver, runtime, card.multiProcessorCount, card.l2CacheSize);
    return text;
}

#else

#include <chrono>
#include <cmath>
#include <cstring>

#define ON_CARD inline
#define ANYWHERE inline
#define KERNEL

struct Place {
    unsigned x;
};
inline Place threadIdx, blockIdx, blockDim;
inline std::vector<uint64_t> shared_memory;

template <class T>
T* to_card(const std::vector<T>& numbers) {
    T* there = new T[std::max<size_t>(1, numbers.size())];
    std::copy(numbers.begin(), numbers.end(), there);
    return there;
}

template <class T>
std::vector<T> from_card(const T* there, size_t count) {
    return std::vector<T>(there, there + count);
}

template <class T>
void fill_on_card(T* there, size_t count, int byte) {
    std::memset(static_cast<void*>(there), byte, count * sizeof(T));
}

template <class Kernel>
void prepare(Kernel, size_t shared) {
    shared_memory.resize(shared / 8 + 1);
}

template <class Kernel, class... Arguments>
double timed(Kernel kernel, unsigned blocks, unsigned threads, size_t, Arguments... arguments) {
    const auto before = std::chrono::steady_clock::now();
    blockDim.x = threads;
    for (blockIdx.x = 0; blockIdx.x < blocks; ++blockIdx.x)
        for (threadIdx.x = 0; threadIdx.x < threads; ++threadIdx.x) kernel(arguments...);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

struct Occupancy {
    int registers, local_bytes, resident;
};

template <class Kernel>
Occupancy occupancy(Kernel, unsigned, size_t) {
    return {0, 0, 1};
}

inline std::string about_card() { return "\"card\": \"none: the processor\""; }

#endif
