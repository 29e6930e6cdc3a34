#include "core/messaging/frame_ring.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace goalmouth {

namespace {
constexpr std::uint64_t ring_magic = 0x474D52494E473031;  // "GMRING01"
constexpr std::uint32_t ring_version = 1;
constexpr std::size_t page = 4096;
constexpr int most_slots = 64;
constexpr std::size_t kept_mappings = 4;
constexpr const char* shared_memory_folder = "/dev/shm";
}  // namespace

/// The start of the shared memory; slot i begins at data_offset + i·slot_bytes, both whole pages.
struct RingLayout {
    struct alignas(64) Slot {  // a cache line each: readers of one slot do not disturb the writing of another
        std::atomic<std::uint64_t> generation;
    };

    std::atomic<std::uint64_t> magic;  // written last
    std::uint32_t version;
    std::uint32_t slots;
    std::uint64_t slot_bytes;
    std::uint64_t data_offset;
    Slot slot[most_slots];
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "shared between processes");

namespace {

constexpr std::size_t whole_pages(std::size_t bytes) {
    return (bytes + page - 1) / page * page;
}
constexpr std::size_t data_offset = whole_pages(sizeof(RingLayout));

/// Where slot i begins, by numbers that were checked: the header could change under a reader's eyes.
std::size_t slot_offset(std::size_t i, std::size_t slot_bytes) {
    return data_offset + i * slot_bytes;
}

std::string prefix_of_user() {
    return "goalmouth-" + std::to_string(getuid()) + "-";
}

std::string new_name(const std::string& camera) {
    std::string name = "/";
    name += prefix_of_user() + std::to_string(getpid()) + "-";
    for (const char c : camera.substr(0, 64)) {
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    std::random_device random;
    return name + "-" + std::to_string(random());
}

bool is_ring_name(const std::string& name) {
    return name.starts_with("/goalmouth-") && name.size() <= 255 && name.find('/', 1) == std::string::npos &&
           name.find('\0') == std::string::npos;
}

/// posix_fallocate, because a hole in a full /dev/shm shows only as a SIGBUS of whoever writes there.
int allocate(int fd, std::size_t bytes) {
    int error = 0;
    do {
        error = posix_fallocate(fd, 0, static_cast<off_t>(bytes));
    } while (error == EINTR);
    return error;
}

/// What can still be had of shared memory; all there is in the world where that is not limited.
std::uint64_t free_bytes() {
    struct statvfs status {};
    if (statvfs(shared_memory_folder, &status) != 0 || status.f_blocks == 0) return UINT64_MAX;
    return std::uint64_t{status.f_bavail} * status.f_frsize;
}

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

bool exists(const std::string& name) {
    const int fd = shm_open(name.c_str(), O_RDONLY | O_CLOEXEC, 0);
    if (fd < 0) return errno != ENOENT;
    close(fd);
    return true;
}

}  // namespace

/// A new segment, locked as long as the producer lives, however it ends: see remove_stale_rings().
void FrameRing::make_segment(const std::string& camera) {
    for (int attempt = 0; attempt < 10; ++attempt) {
        name_ = new_name(camera);
        fd_ = shm_open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (fd_ < 0)
            throw std::runtime_error("cannot make shared memory " + name_ + ": " + std::strerror(errno));
        struct stat status {};
        if (flock(fd_, LOCK_EX | LOCK_NB) == 0 && fstat(fd_, &status) == 0 && status.st_nlink > 0) return;
        // In the moment before it was locked somebody took it for a dead producer's.
        shm_unlink(name_.c_str());
        close(fd_);
    }
    throw std::runtime_error("cannot lock shared memory " + name_);
}

FrameRing::FrameRing(const std::string& camera, int slots, std::size_t slot_bytes)
    : slot_bytes_(whole_pages(slot_bytes)) {
    if (slots < 2 || slots > most_slots || slot_bytes < 1 || slot_bytes > most_slot_bytes) {
        throw std::invalid_argument("a frame ring has 2 to 64 slots of 1 byte to 1 GiB");
    }
    remove_stale_rings();
    states_.resize(static_cast<std::size_t>(slots));
    mapped_bytes_ = slot_offset(states_.size(), slot_bytes_);
    const auto no_memory = [&](const std::string& why) {
        return std::runtime_error(
            "no shared memory for " + std::to_string(slots) + " frames of " + std::to_string(slot_bytes) +
            " bytes (" + megabytes(mapped_bytes_) + "): " + why +
            "; make room in /dev/shm (\"ls -l /dev/shm\" shows what is there), enlarge it "
            "(\"mount -o remount,size=SIZE /dev/shm\") or use fewer frames or buffers");
    };
    // Asked first: an allocation that fails half-way takes from others meanwhile what they may need.
    if (const std::uint64_t left = free_bytes(); left < mapped_bytes_)
        throw no_memory("only " + std::to_string(left / 1'000'000) + " MB are left there");

    make_segment(camera);
    const auto give_up = [&](int error) {
        shm_unlink(name_.c_str());
        close(fd_);
        throw no_memory(std::strerror(error));
    };
    if (const int error = allocate(fd_, mapped_bytes_); error != 0) give_up(error);
    // Populated, or the first frame in each slot would cost a page fault for every 4 kB.
    void* memory = mmap(nullptr, mapped_bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd_, 0);
    if (memory == MAP_FAILED) give_up(errno);
    ring_ = static_cast<RingLayout*>(memory);  // zero pages: every generation is 0
    ring_->version = ring_version;
    ring_->slots = static_cast<std::uint32_t>(slots);
    ring_->slot_bytes = slot_bytes_;
    ring_->data_offset = data_offset;
    ring_->magic.store(ring_magic, std::memory_order_release);
}

FrameRing::~FrameRing() {
    munmap(ring_, mapped_bytes_);
    shm_unlink(name_.c_str());
    close(fd_);
}

int FrameRing::open_slots() const {
    return static_cast<int>(
        std::count_if(states_.begin(), states_.end(), [](const State& s) { return s.open; }));
}

FrameRing::OpenSlot FrameRing::begin_write(std::size_t size) {
    if (size > slot_bytes_) throw std::invalid_argument("a frame larger than its ring's slots");
    const auto oldest = std::min_element(states_.begin(), states_.end(), [](const State& a, const State& b) {
        return a.open != b.open ? b.open : a.finished < b.finished;
    });
    if (oldest->open) throw std::logic_error("every slot of the ring is being written");
    oldest->open = true;
    const auto slot = static_cast<std::size_t>(oldest - states_.begin());
    ring_->slot[slot].generation.store(static_cast<std::uint64_t>(generation_) + 1,
                                       std::memory_order_relaxed);
    // No pixel may become visible before the odd generation. Between processors release order would do; a
    // device that writes by itself is none, so the store has to have left this one before it is told of the
    // slot.
    std::atomic_thread_fence(std::memory_order_seq_cst);
    return {static_cast<int>(slot),
            {reinterpret_cast<std::uint8_t*>(ring_) + slot_offset(slot, slot_bytes_), size}};
}

RingPlace FrameRing::finish_write(int slot) {
    State& state = states_.at(static_cast<std::size_t>(slot));
    if (!state.open) throw std::logic_error("a slot of the ring finished that was not being written");
    generation_ += 2;
    state = {false, generation_};
    // Release order leaves out stores that go past the cache, as copies of megabytes may; this does not. What
    // the kernel wrote is ordered by the system call that said so.
    std::atomic_thread_fence(std::memory_order_seq_cst);
    ring_->slot[static_cast<std::size_t>(slot)].generation.store(static_cast<std::uint64_t>(generation_),
                                                                 std::memory_order_release);
    return {slot, generation_};
}

void FrameRing::abandon(int slot) noexcept {
    states_[static_cast<std::size_t>(slot)] = {};  // its generation stays odd
}

bool RingFrame::still_valid() const {
    // No pixel may be read after the generation.
    std::atomic_thread_fence(std::memory_order_acquire);
    return ring_->slot[slot_].generation.load(std::memory_order_relaxed) == generation_;
}

void RingReader::let_go_of_the_gone() {
    std::erase_if(mappings_, [](const Mapping& mapping) { return !exists(mapping.name); });
}

const RingReader::Mapping* RingReader::mapped(const std::string& name) {
    const auto found =
        std::find_if(mappings_.begin(), mappings_.end(), [&](const Mapping& m) { return m.name == name; });
    if (found != mappings_.end()) {
        std::rotate(found, found + 1, mappings_.end());
        return &mappings_.back();
    }

    failure_ = RingFailure::refused;
    if (!is_ring_name(name)) return nullptr;
    let_go_of_the_gone();
    const int fd = shm_open(name.c_str(), O_RDONLY | O_CLOEXEC, 0);
    if (fd < 0) {
        if (errno == ENOENT) failure_ = RingFailure::gone;
        return nullptr;
    }
    struct stat status {};
    const bool readable = fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
                          status.st_size >= static_cast<off_t>(data_offset);
    const auto size = readable ? static_cast<std::size_t>(status.st_size) : 0;
    void* memory = readable ? mmap(nullptr, size, PROT_READ, MAP_SHARED, fd, 0) : MAP_FAILED;
    close(fd);
    if (memory == MAP_FAILED) return nullptr;

    const std::shared_ptr<const RingLayout> ring(static_cast<const RingLayout*>(memory),
                                                 [memory, size](const RingLayout*) { munmap(memory, size); });
    const Mapping mapping{name, ring, ring->slots, ring->slot_bytes};
    const bool sound = ring->magic.load(std::memory_order_acquire) == ring_magic &&
                       ring->version == ring_version && ring->data_offset == data_offset &&
                       mapping.slots >= 2 && mapping.slots <= most_slots && mapping.slot_bytes >= 1 &&
                       mapping.slot_bytes <= FrameRing::most_slot_bytes &&
                       slot_offset(mapping.slots, mapping.slot_bytes) <= size;
    if (!sound) return nullptr;
#ifdef MADV_POPULATE_READ
    madvise(memory, size, MADV_POPULATE_READ);  // as for the producer; older kernels do without
#endif
    if (mappings_.size() == kept_mappings) mappings_.erase(mappings_.begin());
    mappings_.push_back(mapping);
    return &mappings_.back();
}

std::optional<RingFrame> RingReader::try_open(const image_t& descriptor) {
    const Mapping* mapping = mapped(descriptor.ring);
    if (mapping == nullptr) return {};
    failure_ = RingFailure::refused;
    if (descriptor.slot < 0 || static_cast<std::size_t>(descriptor.slot) >= mapping->slots) return {};
    if (descriptor.size < 0 || static_cast<std::size_t>(descriptor.size) > mapping->slot_bytes) return {};
    if (descriptor.generation <= 0 || descriptor.generation % 2 != 0) return {};

    RingFrame frame;
    frame.ring_ = mapping->ring;
    frame.slot_ = static_cast<std::size_t>(descriptor.slot);
    frame.generation_ = static_cast<std::uint64_t>(descriptor.generation);
    const auto* start = reinterpret_cast<const std::uint8_t*>(mapping->ring.get());
    frame.bytes_ = {start + slot_offset(frame.slot_, mapping->slot_bytes),
                    static_cast<std::size_t>(descriptor.size)};
    if (mapping->ring->slot[frame.slot_].generation.load(std::memory_order_acquire) != frame.generation_) {
        failure_ = RingFailure::overwritten;
        return {};
    }
    failure_ = RingFailure::none;
    return frame;
}

int remove_stale_rings() {
    int removed = 0;
    std::error_code error;
    const std::string prefix = prefix_of_user();
    for (const auto& entry : std::filesystem::directory_iterator(shared_memory_folder, error)) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with(prefix)) continue;
        // Whoever gets the lock knows that its producer is dead: in any process namespace, and although
        // another process may have its number by now.
        const int fd = shm_open(file.c_str(), O_RDONLY | O_CLOEXEC, 0);
        if (fd < 0) continue;
        if (flock(fd, LOCK_EX | LOCK_NB) == 0 && shm_unlink(file.c_str()) == 0) ++removed;
        close(fd);
    }
    return removed;
}

}  // namespace goalmouth
