function [B] = butcher(method_name)
if (strcmp(method_name,'ERK-2-1'))
   A = [0, 0; 2/3, 0];
   c = [0; 2/3];
   b = [1/4, 3/4];
   b2 = [1, 0];
   B = [c, A; 2, b; 1, b2];
elseif (strcmp(method_name,'SDIRK-2-2'))
   gamma = (2-sqrt(2))/2;
   A = [gamma, 0; 1-gamma, gamma];
   c = [gamma; 1];
   b = [1-gamma, gamma];
   b2 = [0, 0];
   B = [c, A; 2, b; 0, b2];
end
