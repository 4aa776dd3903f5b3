function m = kutta()
% a struct, with lines that go on
m.order = 3;
m.A = [0 0 0; ...
       1/2 0 0; ...
       -1 2 0];
m.b = [1/6 2/3 1/6];
m.c = [0 1/2 1];
end
function m = imex()
m.order = 2;
m.A{1,1} = [0 0; 1/2 0];
m.A{1,2} = [0 0; 0 1/2];
m.A{2,1} = [0 0; 1/2 0];
m.A{2,2} = [0 0; 0 1/2];
m.b{1} = [0 1];
m.b{2} = [0 1];
m.c{1} = [0 1/2];
m.c{2} = [0 1/2];
end
