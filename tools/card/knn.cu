// knn: the k nearest photons of each query, one thread a query. Prints a line of JSON for each search and file of queries.
//
// knn PHOTONS START RUNS TRUTH SEARCH[,SEARCH...] QUERIES...
//
// PHOTONS and QUERIES are what export.py writes: records of 20 bytes, and x y z as 32-bit floats. START is the radius that a
// search starts with, RUNS the timed launches of each search after the first, TRUTH the queries of the first
// file that are compared with all photons; what other searches and files give must be the same answers. Runs are interleaved: each search over each file, then all again.
// Exit codes: 0 done, 1 failed or an answer is wrong, 2 asked wrongly.
#include <cstring>
#include <fstream>
#include <functional>
#include <utility>

#include "bucket_tree.h"
#include "kd_tree.h"
#include "search.h"
#include "truth.h"

constexpr unsigned THREADS = 64;

template <class T>
std::vector<T> read_file(const char* path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) {
        std::fprintf(stderr, "knn: %s: cannot be read\n", path);
        std::exit(1);
    }
    const size_t bytes = size_t(file.tellg());
    if (bytes % sizeof(T) != 0) {
        std::fprintf(stderr, "knn: %s: its %zu bytes are no whole number of records of %zu; export.py writes them\n", path, bytes, sizeof(T));
        std::exit(1);
    }
    std::vector<T> numbers(bytes / sizeof(T));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(numbers.data()), std::streamsize(bytes));
    return numbers;
}

struct XYZ {
    float x, y, z;
};

// A file of queries, here and on the card.
struct Queries {
    const char* name;
    std::vector<float> here;
    const float* there;
    uint32_t count;
};

// One way to search, over one file of queries.
struct Case {
    std::string name;
    const Queries* queries;
    size_t map_bytes;
    Occupancy occupancy;
    // Launches it and says how long it took.
    std::function<double(Answer*, Totals*)> launch;
    std::vector<double> seconds;
    uint64_t digest = 0;
    Totals totals{};
    Truth truth;
    std::string distances;
};

template <class Map, class Places>
void add_cases(std::vector<Case>& cases, const std::string& name, Map map, size_t map_bytes, uint32_t photons, float start,
               const std::vector<Queries>& files) {
    const auto kernel = search<Map, Places>;
    const size_t shared = Places::bytes * THREADS;
    prepare(kernel, shared);
    for (const Queries& queries : files)
        cases.push_back({name, &queries, map_bytes, occupancy(kernel, THREADS, shared),
                         [=, &queries](Answer* answers, Totals* totals) {
                             const unsigned blocks = (queries.count + THREADS - 1) / THREADS;
                             return timed(kernel, blocks, THREADS, shared, map, photons, queries.there, queries.count, start, answers, totals);
                         },
                         {}, 0, {}, {}, {}});
}

// Launches a case once, over poisoned answers, and looks at what it found. False if that is not what it found before.
bool run(Case& it, const std::vector<Record>& photons, uint32_t truth, Answer* answers, Totals* totals) {
    const bool first = it.distances.empty();
    fill_on_card(answers, it.queries->count, 0xff);
    fill_on_card(totals, 1, 0);
    const double seconds = it.launch(answers, totals);
    const std::vector<Answer> found = from_card(answers, it.queries->count);
    const uint64_t digest = ::digest(it.queries->here, found);
    const Totals read = from_card(totals, 1)[0];
    if (first) {
        it.digest = digest;
        it.totals = read;
        it.distances = distances(found);
        it.truth = compare_with_truth(photons, it.queries->here, found, truth);
        return true;
    }
    it.seconds.push_back(seconds);
    return digest == it.digest && std::memcmp(&read, &it.totals, sizeof read) == 0;
}

void print(const Case& it, size_t photons) {
    std::printf("{\"search\": \"%s\", \"queries_file\": \"%s\", \"queries\": %u, \"photons\": %zu, \"k\": %d, \"map_bytes\": %zu, ", it.name.c_str(),
                it.queries->name, it.queries->count, photons, K, it.map_bytes);
    std::printf("\"reads\": %llu, \"touches\": %llu, \"attempts\": %llu, \"digest\": \"%016llx\", ", it.totals.records, it.totals.touches,
                it.totals.attempts, static_cast<unsigned long long>(it.digest));
    std::printf("\"truth_checked\": %u, \"truth_wrong\": %u, %s, ", it.truth.checked, it.truth.wrong, it.distances.c_str());
    std::printf("\"registers\": %d, \"local_bytes\": %d, \"resident\": %d, %s, \"seconds\": [", it.occupancy.registers, it.occupancy.local_bytes,
                it.occupancy.resident, about_card().c_str());
    for (size_t at = 0; at < it.seconds.size(); ++at) std::printf("%s%.6f", at > 0 ? ", " : "", it.seconds[at]);
    std::printf("]}\n");
}

int main(int count, char** arguments) {
    if (count < 7) {
        std::fprintf(stderr, "knn: asked wrongly: knn PHOTONS START RUNS TRUTH SEARCH[,SEARCH...] QUERIES...\n");
        return 2;
    }
    const std::vector<Record> photons = read_file<Record>(arguments[1]);
    const float start = std::strtof(arguments[2], nullptr);
    const int runs = std::atoi(arguments[3]);
    const uint32_t truth = uint32_t(std::atoi(arguments[4])), number = uint32_t(photons.size());
    std::vector<Queries> files;
    uint32_t most = 0;
    for (int at = 6; at < count; ++at) {
        const std::vector<XYZ> read = read_file<XYZ>(arguments[at]);
        std::vector<float> here(read.size() * 3);
        std::memcpy(here.data(), read.data(), here.size() * 4);
        const float* there = to_card(here);
        files.push_back({arguments[at], std::move(here), there, uint32_t(read.size())});
        most = std::max(most, uint32_t(read.size()));
    }

    std::vector<Case> cases;
    std::string names = std::string(arguments[5]) + ",";
    KdTree kd{nullptr, number};
    BucketTree bucket{nullptr, nullptr, 0, number};
    for (size_t end; (end = names.find(',')) != std::string::npos; names.erase(0, end + 1)) {
        const std::string name = names.substr(0, end);
        if (name.rfind("kd", 0) == 0 && kd.nodes == nullptr) kd.nodes = to_card(build_kd_tree(photons));
        if (name.rfind("bucket", 0) == 0 && bucket.leaves == nullptr) {
            const Buckets built = build_buckets(photons);
            bucket.splits = to_card(built.splits);
            bucket.leaves = to_card(built.leaves);
            bucket.inner = uint32_t(built.splits.size());
        }
        const size_t kd_bytes = photons.size() * sizeof(Record);
        const size_t bucket_bytes = bucket.inner * sizeof(Pair) + (size_t(bucket.inner) + 1) * LEAF_WORDS * 4;
        if (name == "none") add_cases<NoMap, InLocal<Distance>>(cases, name, {}, 0, 0, start, files);
        else if (name == "kd-shared") add_cases<KdTree, InShared<DistanceAndPhoton>>(cases, name, kd, kd_bytes, number, start, files);
        else if (name == "kd-radius") add_cases<KdTree, InShared<Distance>>(cases, name, kd, kd_bytes, number, start, files);
        else if (name == "kd-local") add_cases<KdTree, InLocal<DistanceAndPhoton>>(cases, name, kd, kd_bytes, number, start, files);
        else if (name == "bucket-shared") add_cases<BucketTree, InShared<DistanceAndPhoton>>(cases, name, bucket, bucket_bytes, number, start, files);
        else if (name == "bucket-radius") add_cases<BucketTree, InShared<Distance>>(cases, name, bucket, bucket_bytes, number, start, files);
        else {
            std::fprintf(stderr, "knn: asked wrongly: no search `%s`; there are kd-shared, kd-radius, kd-local, bucket-shared, bucket-radius, none\n",
                         name.c_str());
            return 2;
        }
    }

    Answer* answers = to_card(std::vector<Answer>(most));
    Totals* totals = to_card(std::vector<Totals>(1));
    bool right = true, compared = false;
    for (int round = 0; round <= runs; ++round)
        for (Case& it : cases)
            // Digests of the others are compared with that of the first.
            if (!run(it, photons, it.map_bytes > 0 && !std::exchange(compared, true) ? truth : 0, answers, totals)) {
                std::fprintf(stderr, "knn: %s over %s: another run gave other answers\n", it.name.c_str(), it.queries->name);
                right = false;
            }
    // All files hold the same queries, in different orders.
    const Case* other = nullptr;
    for (const Case& it : cases) {
        print(it, photons.size());
        if (it.name == "none") continue;
        if (other == nullptr) other = &it;
        if (it.digest != other->digest || it.truth.wrong > 0) {
            std::fprintf(stderr, "knn: %s over %s: %s\n", it.name.c_str(), it.queries->name,
                         it.truth.wrong > 0 ? "k-th distances are wrong" : "answers differ from the first search's");
            right = false;
        }
    }
    return right ? 0 : 1;
}
