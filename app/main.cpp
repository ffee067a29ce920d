#include <cstdio>

int main() {
    std::puts("patina");
    return 0;
}
